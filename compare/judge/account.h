// What a family reports of one pixel, for `explain` and the viewer.
#pragma once

#include <string>
#include <vector>

namespace shadowproof {

struct Account {
    /// A column of the family's table: a number or word for the pixel.
    struct Column {
        std::string title;
        std::string text;
    };
    std::vector<Column> columns; ///< the same titles for every claim of the family
    Column remark;               ///< the table's last column
    std::string note;            ///< text below the table, after the technique's name
    std::string members;         ///< of schema shadowproof/pixel/1, as the text of a JSON object
};

} // namespace shadowproof
