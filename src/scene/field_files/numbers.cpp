#include "scene/field_files/numbers.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

namespace shoal {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

}  // namespace

NumberScanner::NumberScanner(const std::string& text, const std::string& file)
    : text_(&text), file_(&file), end_(text.size()) {
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) position_ = lineStart_ = 3;
}

NumberScanner::NumberScanner(const std::string& text, size_t begin, size_t end, const std::string& file)
    : text_(&text), file_(&file), position_(begin), end_(end) {
    const Location start = locate(text, begin, file);
    line_ = beginLine_ = start.line;
    lineStart_ = beginLineStart_ = begin - size_t(start.column - 1);
    begin_ = begin;
}

bool NumberScanner::next(double& out) {
    const std::string& text = *text_;
    skipSpace();
    begin_ = position_;
    beginLine_ = line_;
    beginLineStart_ = lineStart_;
    if (position_ == end_) return false;
    size_t end = position_;
    while (end < end_ && text[end] != ',' && !isSpace(text[end]))
        ++end;
    out = convert(position_, end);
    position_ = end;
    skipSpace();
    if (position_ < end_ && text[position_] == ',') ++position_;
    return true;
}

void NumberScanner::skipSpace() {
    for (; position_ < end_ && isSpace((*text_)[position_]); ++position_)
        if ((*text_)[position_] == '\n') {
            ++line_;
            lineStart_ = position_ + 1;
        }
}

double NumberScanner::convert(size_t begin, size_t end) const {
    const bool plus = begin < end && (*text_)[begin] == '+';
    const char *first = text_->data() + begin + (plus ? 1 : 0), *last = text_->data() + end;
    double value = 0;
    const auto [stop, code] = std::from_chars(first, last, value);
    if (code == std::errc::result_out_of_range && stop == last)
        throw Error(here(), concat("expected a number in the range of doubles, found ", quoted(begin, end)));
    if (code != std::errc() || stop != last)
        throw Error(here(), concat("expected a number, found ", quoted(begin, end)));
    if (!std::isfinite(value))
        throw Error(here(), concat("expected a finite number, found ", quoted(begin, end)));
    return value;
}

std::string NumberScanner::quoted(size_t begin, size_t end) const {
    if (begin == end) return "\",\"";
    std::string out = text_->substr(begin, std::min<size_t>(end - begin, 24));
    for (char& c : out)
        if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return "\"" + out + (end - begin > 24 ? "...\"" : "\"");
}

void takeNumbers(std::span<const std::byte> bytes, NumberType type, bool bigEndian, std::span<float> out) {
    const size_t size = bytesOf(type);
    if (type == NumberType::float32 && bigEndian == (std::endian::native == std::endian::big)) {
        std::memcpy(out.data(), bytes.data(), out.size_bytes());
        return;
    }
    for (size_t i = 0; i < out.size(); ++i) {
        uint64_t bits = 0;
        for (size_t b = 0; b < size; ++b)
            bits |= uint64_t(bytes[i * size + (bigEndian ? size - 1 - b : b)]) << (8 * b);
        if (type == NumberType::float16)
            out[i] = glm::unpackHalf1x16(uint16_t(bits));
        else if (type == NumberType::float32)
            out[i] = std::bit_cast<float>(uint32_t(bits));
        else
            out[i] = float(std::bit_cast<double>(bits));
    }
}

}  // namespace shoal
