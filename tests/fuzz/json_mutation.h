// Mutations of a JSON tree: the text stays JSON, what it says does not.
#pragma once

#include "tests/dice.h"
#include "tests/fuzz/hostile_number.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof::fuzz {

/// Pointers to all values below and including `root`; strings longer than 4 KiB, which hold whole
/// files, are left out.
template <class Json>
std::vector<Json*> values_of(Json& root) {
    std::vector<Json*> found{&root};
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i]->is_structured())
            for (Json& child : *found[i])
                if (!child.is_string() ||
                    child.template get_ref<const std::string&>().size() <= 4096)
                    found.push_back(&child);
    return found;
}

/// A value of any type, often one that breaks assumptions.
template <class Json>
Json hostile_value(std::span<const std::string_view> words, Dice& dice) {
    switch (dice.below(12)) {
    case 0:
        return nullptr;
    case 1:
        return Json::array();
    case 2:
        return Json::object();
    case 3:
        return dice.one_in(2);
    case 4:
        return static_cast<std::int64_t>(dice.below(5)) - 1;
    case 5:
        return std::numeric_limits<std::uint64_t>::max() >> dice.below(64);
    case 6:
        return std::numeric_limits<std::int64_t>::min() >> dice.below(64);
    case 7:
        return special<double>(dice);
    case 8:
        return std::string(dice.below(3), static_cast<char>(dice.bits()));
    case 9:
        return Json::array({0, 0, 0, 1});
    default:
        return words.empty() ? Json("") : Json(std::string(dice.one_of(words)));
    }
}

template <class Json>
void move_scalar(Json& value, std::span<const std::string_view> words, Dice& dice) {
    if (value.is_number_float()) {
        value = moved(value.template get<double>(), dice);
    } else if (value.is_number()) {
        const auto number = value.template get<std::int64_t>();
        if (dice.one_in(4)) {
            value = hostile_value<Json>(words, dice);
        } else {
            // In unsigned arithmetic, which wraps.
            const auto step = static_cast<std::uint64_t>(dice.below(7)) - 3;
            value = static_cast<std::int64_t>(static_cast<std::uint64_t>(number) + step);
        }
    } else if (value.is_boolean()) {
        value = !value.template get<bool>();
    } else if (value.is_string() && !dice.one_in(3)) {
        auto text = value.template get<std::string>();
        if (text.empty() || dice.one_in(3))
            text.insert(dice.below(text.size() + 1), 1, static_cast<char>(dice.bits()));
        else if (dice.one_in(2))
            text.erase(dice.below(text.size()), 1 + dice.below(3));
        else
            text[dice.below(text.size())] = static_cast<char>(dice.bits());
        value = text;
    } else {
        value = hostile_value<Json>(words, dice);
    }
}

/// One change somewhere in the tree. `words`: names and strings that the format gives a meaning.
template <class Json>
void mutate_json(Json& root, std::span<const std::string_view> words, Dice& dice) {
    const std::vector<Json*> all = values_of(root);
    Json& value = *all[dice.below(all.size())];
    switch (value.is_structured() ? dice.below(8) : 7 + dice.below(4)) {
    case 0: // drop a member
    case 1:
        if (!value.empty())
            value.erase(
                std::next(value.begin(), static_cast<std::ptrdiff_t>(dice.below(value.size()))));
        break;
    case 2: // double an element, or give a member another name
        if (value.is_array() && !value.empty() && value.size() < 1000)
            value.push_back(Json(value[dice.below(value.size())]));
        else if (value.is_object() && !value.empty() && !words.empty())
            value[std::string(dice.one_of(words))] = Json(
                *std::next(value.begin(), static_cast<std::ptrdiff_t>(dice.below(value.size()))));
        break;
    case 3: // swap two elements
        if (value.is_array() && value.size() > 1)
            std::swap(value[dice.below(value.size())], value[dice.below(value.size())]);
        break;
    case 4: // a new member
        if (value.is_object() && !words.empty())
            value[std::string(dice.one_of(words))] = hostile_value<Json>(words, dice);
        else if (value.is_array() && value.size() < 1000)
            value.push_back(hostile_value<Json>(words, dice));
        break;
    case 5: // a whole subtree from elsewhere; a copy, as it may hold this one
    case 7: {
        Json other = *all[dice.below(all.size())];
        if (other.is_structured() &&
            other.dump(-1, ' ', false, Json::error_handler_t::replace).size() > 20000)
            break;
        value = std::move(other);
        break;
    }
    case 6:
        value = hostile_value<Json>(words, dice);
        break;
    default:
        move_scalar(value, words, dice);
    }
}

} // namespace shadowproof::fuzz
