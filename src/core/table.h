// Tables of results as text and CSV. What a row holds is told once, as the JSON of a report; a column picks a
// value from it by its key and says how people read it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/json.h"

namespace shoal {

struct Column {
    const char* key;               // of the row, or of an object in it: "error.total"; "" is the number 1
    const char* title;             // above it
    int width = 0;                 // in text; below 0 for cells that begin to the left
    const char* format = nullptr;  // of numbers, as for std::printf; null: as shortNumber
    double scale = 1;              // 1e3 shows seconds as ms
    const char* per = nullptr;     // the key by whose number it is divided
};

// Three digits that count, without an exponent.
std::string shortNumber(double value);

// The head, then a line for each row. A value that is null or missing is a dash. A row with one of the keys
// "leftOut", "failed" and "unmeasured" ends with these words in place of its values. With `group`, the key of
// a text or number, rows that follow one another and agree in it stand under it, with a head of their own.
std::string tableText(std::span<const Column> columns, const std::vector<JsonValue>& rows,
                      const char* group = nullptr);

// The head, then a line for each row of what it has under the keys, which commas separate: numbers to nine
// digits, flags as 0 and 1, texts with a comma or quote in quotes.
std::string tableCsv(const std::string& head, const std::string& keys, const std::vector<JsonValue>& rows);

}  // namespace shoal
