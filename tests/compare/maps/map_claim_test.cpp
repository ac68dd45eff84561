#include "compare/maps/map_claim.h"
#include "scenes/load/catalog.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

/// `ordinary` traced, and a claim about it made by hand.
struct Handmade {
    Scene scene =
        load_scene("ordinary", {.camera = {}, .light = {}, .time = 0, .width = 16, .height = 16});
    Tracer tracer{scene};
    GroundTruth truth = trace(tracer);
    TracedScene traced{tracer, truth};
    Frame frame{};
    JudgedClaim claim{traced, frame};

    Handmade() {
        frame.claim = truth.visibility;
        MapEvidence& map = frame.mapped.emplace();
        map.model.filter = 4;
        frame.share = Image<double>(16, 16);
    }

    /// A pixel whose truth is that.
    PixelPlace place_of(Visibility visibility) const {
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                if (truth.visibility.at(x, y) == visibility) return {x, y};
        return {-1, -1};
    }
    /// What the claim says there: so many of 16 comparisons find light.
    void say(PixelPlace p, Visibility visibility, int lit = 0) {
        frame.claim.at(p.x, p.y) = visibility;
        frame.share.at(p.x, p.y) = lit / 16.0;
    }
};

TEST(MapClaim, counts_the_comparisons_that_it_says_to_find_light) {
    Handmade given;
    const PixelPlace p = given.place_of(Visibility::lit);
    const auto said = [&](Visibility visibility, int lit) {
        given.say(p, visibility, lit);
        return claimed_lit(given.claim, p);
    };
    EXPECT_EQ(said(Visibility::lit, 0), 16);
    EXPECT_EQ(said(Visibility::shadowed, 0), 0);
    EXPECT_EQ(said(Visibility::partly_lit, 11), 11);
    // It contradicts itself: all or none is not a part, background has no light.
    EXPECT_EQ(said(Visibility::partly_lit, 0), -1);
    EXPECT_EQ(said(Visibility::partly_lit, 16), -1);
    EXPECT_EQ(said(Visibility::background, 3), -1);
    // Nor does a share that 16 comparisons cannot have.
    given.frame.share.at(p.x, p.y) = std::nextafter(11 / 16.0, 1);
    EXPECT_EQ(claimed_lit(given.claim, p), -1);
    // Nor is there a share where values are averaged and compared once, or no picture of shares.
    given.say(p, Visibility::partly_lit, 11);
    given.frame.mapped->model.average = MapAverage::values;
    EXPECT_EQ(said(Visibility::partly_lit, 11), -1);
    given.frame.mapped->model.average = MapAverage::comparisons;
    given.frame.share = {};
    EXPECT_EQ(claimed_lit(given.claim, p), -1);
}

TEST(MapClaim, shows_light_where_it_claims_a_share_of_it_and_there_is_none) {
    Handmade given;
    const PixelPlace lit = given.place_of(Visibility::lit);
    const PixelPlace shadowed = given.place_of(Visibility::shadowed);
    given.say(lit, Visibility::partly_lit, 11);
    EXPECT_FALSE(claims_light(given.claim, lit));
    given.say(shadowed, Visibility::partly_lit, 11);
    EXPECT_TRUE(claims_light(given.claim, shadowed));
    given.say(shadowed, Visibility::lit);
    EXPECT_TRUE(claims_light(given.claim, shadowed));
}

} // namespace
} // namespace shadowproof
