#include "geometry/ply_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "geometry/model_reader.h"

namespace shoal {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr TypeName typeNames[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

bool isBlank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> out;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const auto end = std::find_if(text.begin(), text.end(), isBlank);
        out.push_back(text.substr(0, size_t(end - text.begin())));
        text.remove_prefix(out.back().size());
    }
    return out;
}

// Messages quote a file, whatever it holds.
std::string quoted(std::string_view text) {
    constexpr size_t longest = 40;
    return concat("\"", text.substr(0, longest), text.size() > longest ? "..." : "", "\"");
}

template <typename T>
double number(const char* bytes, bool swapped) {
    char copy[sizeof(T)];
    std::memcpy(copy, bytes, sizeof(T));
    if (swapped) std::reverse(copy, copy + sizeof(T));
    T out;
    std::memcpy(&out, copy, sizeof(T));
    return double(out);
}

}  // namespace

size_t bytesOf(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

double fullShare(PlyType type) {
    switch (type) {
    case PlyType::int8:
        return std::numeric_limits<int8_t>::max();
    case PlyType::uint8:
        return std::numeric_limits<uint8_t>::max();
    case PlyType::int16:
        return std::numeric_limits<int16_t>::max();
    case PlyType::uint16:
        return std::numeric_limits<uint16_t>::max();
    case PlyType::int32:
        return std::numeric_limits<int32_t>::max();
    case PlyType::uint32:
        return std::numeric_limits<uint32_t>::max();
    default:
        return 1;
    }
}

// ---- The header

PlyFile::PlyFile(std::string bytes, const std::string& file)
    : bytes_(std::move(bytes)), location_{file, 0, 0, {}} {
    // A byte of the data may look like a newline: what ends the header is what ends its first line.
    const size_t end = bytes_.find_first_of("\r\n");
    newline_ = end == std::string::npos              ? ""
               : bytes_.compare(end, 2, "\r\n") == 0 ? "\r\n"
               : bytes_[end] == '\r'                 ? "\r"
                                                     : "\n";
    readHeader();
}

std::string_view PlyFile::headerLine() {
    const size_t end = newline_.empty() ? std::string::npos : bytes_.find(newline_, at_);
    ++line_;
    rowLine_ = line_;
    if (end == std::string::npos) throw fail("the file ends within its header, expected \"end_header\"");
    const std::string_view line = std::string_view(bytes_).substr(at_, end - at_);
    at_ = end + newline_.size();
    return trimmed(line);
}

void PlyFile::readHeader() {
    if (headerLine() != "ply") throw fail("expected \"ply\" in the first line");
    bool known = false;
    for (std::string_view line = headerLine(); line != "end_header"; line = headerLine()) {
        const std::vector<std::string_view> words = wordsOf(line);
        if (words.empty()) continue;
        if (words[0] == "comment" || words[0] == "obj_info") {
            if (words[0] == "comment") comments_.emplace_back(trimmed(line.substr(words[0].size())));
        } else if (words[0] == "element") {
            addElement(words);
        } else if (words[0] == "property") {
            addProperty(words);
        } else if (words[0] == "format" && words.size() > 1) {
            known = true;
            text_ = words[1] == "ascii";
            const bool little = words[1] == "binary_little_endian";
            if (!text_ && !little && words[1] != "binary_big_endian")
                throw fail(concat("expected ascii, binary_little_endian or binary_big_endian, found ",
                                  quoted(words[1])));
            swapped_ = little != (std::endian::native == std::endian::little);
        } else if (elements_.empty()) {
            comments_.emplace_back(line);  // as old programs write them, without the word
        } else {
            throw fail("expected a line of a PLY header, found " + quoted(line));
        }
    }
    if (!known) throw fail("the header does not say the format");
    ++line_;
}

void PlyFile::addElement(const std::vector<std::string_view>& words) {
    PlyElement out;
    const std::string_view count = words.size() == 3 ? words[2] : "";
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), out.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
        throw fail("expected \"element\", a name and a whole number");
    out.name = words[1];
    for (const PlyElement& other : elements_)
        if (other.name == out.name) throw fail(concat("there are two elements ", quoted(out.name)));
    elements_.push_back(std::move(out));
}

void PlyFile::addProperty(const std::vector<std::string_view>& words) {
    const auto typeOf = [&](std::string_view word) {
        for (const TypeName& known : typeNames)
            if (known.name == word) return known.type;
        throw fail("there is no type " + quoted(word));
    };
    const bool list = words.size() > 1 && words[1] == "list";
    if (words.size() != (list ? 5u : 3u) || elements_.empty())
        throw fail("expected a property's type and name, behind an element");
    PlyProperty out{std::string(words.back()), typeOf(words[words.size() - 2]), {}};
    if (list) out.countType = typeOf(words[2]);
    for (const PlyProperty& other : elements_.back().properties)
        if (other.name == out.name) throw fail(concat("there are two properties ", quoted(out.name)));
    elements_.back().properties.push_back(std::move(out));
}

// ---- The rows

void PlyFile::begin(const PlyElement& element) {
    element_ = &element;
    rows_ = 0;
    size_t least = 0;  // bytes that a row takes; in a text a digit and a blank, the last one's left out
    for (const PlyProperty& property : element.properties)
        least += text_ ? 2 : bytesOf(property.countType.value_or(property.type));
    const size_t left = bytes_.size() - at_ + (text_ ? 1 : 0);
    if (least > 0 && element.count > left / least)
        throw Error(location_, "cannot be read: its header announces ", element.count, " of element ",
                    quoted(element.name), ", which take more than the ", bytes_.size() - at_,
                    " bytes that are left of the file");
}

void PlyFile::next(PlyRow& row) {
    row.numbers.assign(element_->properties.size(), 0);
    row.lists.resize(element_->properties.size());
    if (text_) skipBlanks();
    rowLine_ = line_;
    row_ = rows_++;
    for (size_t i = 0; i < element_->properties.size(); ++i) {
        const PlyProperty& property = element_->properties[i];
        if (!property.countType) {
            row.numbers[i] = value(property.type);
            continue;
        }
        row.lists[i].resize(lengthOf(property));
        for (double& number : row.lists[i])
            number = value(property.type);
    }
    if (text_) {
        while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r' && isBlank(bytes_[at_]))
            ++at_;
        if (at_ < bytes_.size() && !isBlank(bytes_[at_]))
            throw fail("the line has more numbers than the header announces");
    }
}

size_t PlyFile::lengthOf(const PlyProperty& list) {
    const double length = value(*list.countType);
    const size_t left = (bytes_.size() - at_) / (text_ ? 2 : bytesOf(list.type)) + (text_ ? 1 : 0);
    if (!(length >= 0) || length != std::floor(length))
        throw fail(concat("list ", quoted(list.name), " has a length of ", length,
                          ", expected a whole number, 0 or more"));
    if (length > double(left))
        throw fail(concat("list ", quoted(list.name), " has a length of ", formatted("%.0f", length),
                          ", more than what is left of the file"));
    return size_t(length);
}

double PlyFile::value(PlyType type) {
    return text_ ? written() : stored(type);
}

double PlyFile::written() {
    skipBlanks();
    const char *from = bytes_.data() + at_, *last = bytes_.data() + bytes_.size();
    const char* until = std::find_if(from, last, isBlank);
    if (from == until) throw fail("the file ends here");
    const char* sign = *from == '+' ? from + 1 : from;
    double out = 0;
    const auto [end, error] = std::from_chars(sign, until, out);
    if (end != until || (error != std::errc() && error != std::errc::result_out_of_range))
        throw fail("expected a number, found " + quoted({from, size_t(until - from)}));
    if (error != std::errc()) out = std::strtod(std::string(sign, until).c_str(), nullptr);  // 0 or infinite
    at_ += size_t(until - from);
    return out;
}

double PlyFile::stored(PlyType type) {
    const size_t bytes = bytesOf(type);
    if (bytes > bytes_.size() - at_) throw fail("the file ends here");
    const char* from = bytes_.data() + at_;
    at_ += bytes;
    switch (type) {
    case PlyType::int8:
        return number<int8_t>(from, swapped_);
    case PlyType::uint8:
        return number<uint8_t>(from, swapped_);
    case PlyType::int16:
        return number<int16_t>(from, swapped_);
    case PlyType::uint16:
        return number<uint16_t>(from, swapped_);
    case PlyType::int32:
        return number<int32_t>(from, swapped_);
    case PlyType::uint32:
        return number<uint32_t>(from, swapped_);
    case PlyType::float32:
        return number<float>(from, swapped_);
    case PlyType::float64:
        return number<double>(from, swapped_);
    }
    return 0;
}

void PlyFile::skipBlanks() {
    for (; at_ < bytes_.size() && isBlank(bytes_[at_]); ++at_)
        if (bytes_[at_] == '\n' || (bytes_[at_] == '\r' && bytes_.compare(at_, 2, "\r\n") != 0)) ++line_;
}

size_t PlyFile::left() {
    if (text_) skipBlanks();
    return bytes_.size() - at_;
}

Error PlyFile::fail(const std::string& message) const {
    Location location = location_;
    if (text_ || !element_) location.line = int(rowLine_);
    const std::string where =
        element_ ? concat(element_->name, " ", row_, " of ", element_->count, ": ") : std::string();
    return Error(location, concat("cannot be read: ", where, message));
}

}  // namespace shoal
