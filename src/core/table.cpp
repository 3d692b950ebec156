#include "core/table.h"

#include <sstream>
#include <utility>

#include "core/printable.h"

namespace shoal {

namespace {

const JsonValue* valueOf(const JsonValue& row, const std::string& key) {
    const size_t dot = key.find('.');
    const JsonValue* found = row.find(key.substr(0, dot));
    if (found && dot != std::string::npos) found = found->find(key.substr(dot + 1));
    return found && found->kind != JsonValue::Kind::null ? found : nullptr;
}

std::string cell(const Column& column, const JsonValue& row) {
    static const JsonValue unit = JsonValue::makeNumber(1);
    const JsonValue* value = *column.key ? valueOf(row, column.key) : &unit;
    const JsonValue* divisor = column.per ? valueOf(row, column.per) : &unit;
    if (!value || !divisor || divisor->number == 0) return "-";
    if (value->kind == JsonValue::Kind::string) return printable(value->text);
    if (value->kind == JsonValue::Kind::boolean) return value->boolean ? "yes" : "no";
    const double number = value->number * column.scale / divisor->number;
    return column.format ? formatted(column.format, number) : shortNumber(number);
}

std::string csvCell(const JsonValue* value) {
    if (!value) return "";
    if (value->kind == JsonValue::Kind::boolean) return value->boolean ? "1" : "0";
    if (value->kind == JsonValue::Kind::number) return formatted("%.9g", value->number);
    std::string text = printable(value->text);
    if (text.find_first_of(",\"") == std::string::npos) return text;
    for (size_t quote = 0; (quote = text.find('"', quote)) != std::string::npos; quote += 2)
        text.insert(quote, "\"");
    return "\"" + text + "\"";
}

std::string padded(const Column& column, const std::string& text) {
    return formatted("%*s", column.width, text.c_str());
}

std::string line(const std::string& text) {
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string rowText(std::span<const Column> columns, const JsonValue& row) {
    std::string out = "  ";
    for (const auto& [key, words] :
         {std::pair("leftOut", "left out: "), {"failed", "failed: "}, {"unmeasured", ""}}) {
        const JsonValue* why = valueOf(row, key);
        if (!why) continue;
        for (const Column& column : columns) {
            if (!*column.key || !valueOf(row, column.key)) break;
            out += padded(column, cell(column, row));
        }
        return line(concat(out, "  ", words, printable(why->text)));
    }
    for (const Column& column : columns)
        out += padded(column, cell(column, row));
    return line(out);
}

}  // namespace

std::string shortNumber(double value) {
    return formatted("%.*f", value < 10 ? 2 : value < 100 ? 1 : 0, value);
}

std::string tableText(std::span<const Column> columns, const std::vector<JsonValue>& rows,
                      const char* group) {
    std::string head, out, last;
    for (const Column& column : columns)
        head += padded(column, column.title);
    for (const JsonValue& row : rows) {
        const JsonValue* value = group ? valueOf(row, group) : nullptr;
        const std::string part = !value                                   ? ""
                                 : value->kind == JsonValue::Kind::string ? printable(value->text)
                                                                          : concat(group, " ", value->text);
        if (out.empty() || part != last) out += (group ? concat("\n", part, "\n") : "") + line("  " + head);
        last = part;
        out += rowText(columns, row);
    }
    return out;
}

std::string tableCsv(const std::string& head, const std::string& keys, const std::vector<JsonValue>& rows) {
    std::string out = head + "\n";
    for (const JsonValue& row : rows) {
        std::istringstream names(keys);
        for (std::string name; std::getline(names, name, ',');)
            out += csvCell(valueOf(row, name)) + (names.eof() ? "\n" : ",");
    }
    return out;
}

}  // namespace shoal
