#include "compare/report/report_template.h"

#include <cassert>
#include <set>

namespace shadowproof {

std::string fill(std::string_view text, const Gaps& values) {
    std::string result;
    [[maybe_unused]] std::set<std::string_view> used;
    for (;;) {
        const std::size_t open = text.find("{{");
        const std::size_t close = text.find("}}", open);
        result += text.substr(0, open);
        if (open == std::string_view::npos || close == std::string_view::npos) break;
        const auto value = values.find(text.substr(open + 2, close - open - 2));
        assert(value != values.end());
        if (value != values.end()) {
            result += value->second;
            used.insert(value->first);
        }
        text.remove_prefix(close + 2);
    }
    assert(used.size() == values.size());
    return result;
}

} // namespace shadowproof
