#include "core/where.h"

#include <algorithm>
#include <cmath>

namespace shoal {

std::string Where::path() const {
    if (parent_ == nullptr) return reader_ ? reader_->path() : "$";
    // Without concat(), which takes its time: there is one for each spring.
    std::string out = parent_->path();
    if (*key_) out.append(".").append(key_);
    if (index_ != none) out.append("[").append(std::to_string(index_)).append("]");
    return out;
}

const JsonReader* Where::root() const {
    return parent_ ? parent_->root() : reader_;
}

const JsonValue* Where::value() const {
    if (parent_ == nullptr) return reader_ ? &reader_->value() : nullptr;
    const JsonValue* outer = parent_->value();
    const JsonValue* inner = outer && *key_ ? outer->find(key_) : outer;
    if (inner && index_ != none) return index_ < inner->items.size() ? &inner->items[index_] : nullptr;
    return inner;
}

Location Where::here() const {
    const JsonReader* file = root();
    const JsonValue* own = value();
    if (!file) return {{}, 0, 0, path()};
    return own ? Location{file->file(), own->line, own->column, path()} : parent_->here();
}

Location Where::locate(const std::string& key) const {
    return in(key.c_str()).here();
}

bool Where::given(const std::string& key) const {
    return in(key.c_str()).value() != nullptr;
}

double Where::number(const std::string& key, double fallback) const {
    const JsonValue* value = in(key.c_str()).value();
    return value ? value->number : fallback;
}

void Where::require(const std::string& key) const {
    if (reader_) return reader_->require(key);
    if (root() && !given(key)) throw Error(here(), "missing key \"" + key + "\"");
}

void needAtMost(const Where& where, const std::string& key, size_t count, size_t most) {
    if (count > most) throw Error(where.locate(key), "expected at most ", most, " ", key, ", found ", count);
}

void needFormat(JsonReader& root, const std::string& expected) {
    std::string format;
    root.need("format", format);
    if (format == expected) return;
    const size_t number = expected.rfind('-') + 1;
    const bool kin = format.compare(0, number, expected, 0, number) == 0 && format.size() > number &&
                     format.find_first_not_of("0123456789", number) == std::string::npos;
    throw Error(root.locate("format"), "expected the format \"", expected, "\", found \"", format, "\"",
                kin ? ": the file is of a newer version of Shoal" : "");
}

void checkBox(const Box& box, bool flat, const Location& where) {
    for (int i = 0; i < 3; ++i)
        if (flat ? box.low[i] > box.high[i] : box.low[i] >= box.high[i])
            throw Error(where, "expected high above low along every axis, found ", box.high[i], " against ",
                        box.low[i], " along ", "xyz"[i]);
}

}  // namespace shoal
