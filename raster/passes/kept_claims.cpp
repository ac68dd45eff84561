#include "raster/passes/kept_claims.h"

namespace shadowproof {

namespace {

void copy(const GlFunctions& gl, const Target& target, const Texture& from, const Texture& to) {
    gl.CopyImageSubData(from.name(), GL_TEXTURE_2D, 0, 0, 0, 0, to.name(), GL_TEXTURE_2D, 0, 0, 0,
                        0, target.width, target.height, 1);
}

} // namespace

KeptClaims make_kept_claims(const GlFunctions& gl, const Target& target, std::size_t lights) {
    KeptClaims kept;
    if (lights < 2) return kept;
    kept.unlit = make_claim(gl, target.width, target.height);
    for (std::size_t i = 0; i + 1 < lights; ++i)
        kept.lit.push_back(make_claim(gl, target.width, target.height));
    return kept;
}

void keep_unlit(const GlFunctions& gl, const Target& target, const KeptClaims& kept) {
    if (!kept.lit.empty()) copy(gl, target, target.claim, kept.unlit);
}

void take_unlit(const GlFunctions& gl, const Target& target, const KeptClaims& kept) {
    copy(gl, target, kept.unlit, target.claim);
}

void keep_claim(const GlFunctions& gl, const Target& target, const KeptClaims& kept,
                std::size_t light) {
    if (light < kept.lit.size()) copy(gl, target, target.claim, kept.lit[light]);
}

std::vector<Image<Visibility>> read_claims(const GlFunctions& gl, const Target& target,
                                           const KeptClaims& kept) {
    std::vector<Image<Visibility>> claims;
    for (const Texture& claim : kept.lit) {
        copy(gl, target, claim, target.claim);
        claims.push_back(read_claim(gl, target));
    }
    check(gl, "reading back the claims of several lights");
    return claims;
}

} // namespace shadowproof
