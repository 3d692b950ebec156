#include "core/where.h"

namespace shoal {

std::string Where::path() const {
    if (parent_ == nullptr) return reader_ ? reader_->path() : "$";
    return concat(parent_->path(), ".", key_, index_ == none ? "" : concat("[", index_, "]"));
}

const JsonReader* Where::root() const {
    return parent_ ? parent_->root() : reader_;
}

const JsonValue* Where::value() const {
    if (parent_ == nullptr) return reader_ ? &reader_->value() : nullptr;
    const JsonValue* outer = parent_->value();
    const JsonValue* inner = outer ? outer->find(key_) : nullptr;
    if (inner && index_ != none) return index_ < inner->items.size() ? &inner->items[index_] : nullptr;
    return inner;
}

Location Where::here() const {
    const JsonReader* file = root();
    const JsonValue* own = value();
    if (!file) return {{}, 0, 0, path()};
    return own ? Location{file->file(), own->line, own->column, path()} : parent_->here();
}

Location Where::at(const std::string& key) const {
    const JsonReader* file = root();
    if (!file) return {{}, 0, 0, path() + "." + key};
    const JsonValue* own = value();
    const JsonValue* inner = own ? own->find(key) : nullptr;
    return inner ? Location{file->file(), inner->line, inner->column, path() + "." + key} : here();
}

bool Where::given(const std::string& key) const {
    const JsonValue* own = value();
    return own && own->find(key);
}

double Where::number(const std::string& key, double fallback) const {
    const JsonValue* own = value();
    const JsonValue* inner = own ? own->find(key) : nullptr;
    return inner ? inner->number : fallback;
}

void Where::require(const std::string& key) const {
    if (reader_) return reader_->require(key);
    if (root() && !given(key)) throw Error(here(), "missing key \"" + key + "\"");
}

void needAtMost(const Where& where, const std::string& key, size_t count, size_t most) {
    if (count > most)
        throw Error(where.at(key), concat("expected at most ", most, " ", key, ", found ", count));
}

void needFormat(JsonReader& root, const std::string& expected) {
    std::string format;
    root.need("format", format);
    if (format == expected) return;
    const size_t number = expected.rfind('-') + 1;
    const bool kin = format.compare(0, number, expected, 0, number) == 0 && format.size() > number &&
                     format.find_first_not_of("0123456789", number) == std::string::npos;
    throw Error(root.at("format"), concat("expected the format \"", expected, "\", found \"", format, "\"",
                                          kin ? ": the file is of a newer version of Shoal" : ""));
}

}  // namespace shoal
