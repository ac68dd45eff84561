#include "compare/json/coded_lists.h"
#include "compare/json/number_column.h"

namespace shadowproof {

std::string coded_sequence(Numbers values, std::uint32_t columns) {
    BitCoder coder;
    std::vector<NumberColumn> all(columns, NumberColumn(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        code_next(coder, all[i % columns], values[i], i >= 2 ? values[i - 2] : 0,
                  i >= 1 ? values[i - 1] : 0, i >= columns ? values[i - columns] : 0);
    return coder.finish();
}

} // namespace shadowproof
