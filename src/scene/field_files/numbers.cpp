#include "scene/field_files/field_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <zlib.h>
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
        throw Error(here(), "expected a number in the range of doubles, found ", quoted(begin, end));
    if (code != std::errc() || stop != last)
        throw Error(here(), "expected a number, found ", quoted(begin, end));
    if (!std::isfinite(value)) throw Error(here(), "expected a finite number, found ", quoted(begin, end));
    return value;
}

std::string NumberScanner::quoted(size_t begin, size_t end) const {
    if (begin == end) return "\",\"";
    std::string out = text_->substr(begin, std::min<size_t>(end - begin, 24));
    for (char& c : out)
        if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return "\"" + out + (end - begin > 24 ? "...\"" : "\"");
}

std::vector<glm::vec3> takeVelocities(NumberScanner& numbers, size_t cells) {
    std::vector<glm::vec3> out(cells);
    size_t found = 0;
    for (float& velocity : asFloats(out)) {
        double value = 0;
        if (!numbers.next(value))
            throw Error(numbers.here(), "expected ", 3 * cells, " values, found ", found);
        if (!(std::abs(value) < largestInFiles))
            throw Error(numbers.here(), "a velocity of ", value, " is beyond single precision");
        velocity = float(value);
        ++found;
    }
    return out;
}

size_t bytesOf(NumberType type) {
    switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
        return 1;
    case NumberType::float16:
    case NumberType::int16:
    case NumberType::uint16:
        return 2;
    case NumberType::float32:
    case NumberType::int32:
    case NumberType::uint32:
        return 4;
    default:
        return 8;
    }
}

namespace {

float asFloat(uint64_t bits, NumberType type) {
    switch (type) {
    case NumberType::float16:
        return glm::unpackHalf1x16(uint16_t(bits));
    case NumberType::float32:
        return std::bit_cast<float>(uint32_t(bits));
    case NumberType::float64:
        return float(std::bit_cast<double>(bits));
    case NumberType::int8:
        return float(int8_t(bits));
    case NumberType::int16:
        return float(int16_t(bits));
    case NumberType::int32:
        return float(int32_t(bits));
    case NumberType::int64:
        return float(int64_t(bits));
    default:
        return float(bits);
    }
}

}  // namespace

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
        out[i] = asFloat(bits, type);
    }
}

// ---- Arrays of VTK

namespace {

constexpr uint8_t notADigit = 64;

constexpr std::array<uint8_t, 256> base64Digits() {
    std::array<uint8_t, 256> out{};
    out.fill(notADigit);
    const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (uint8_t i = 0; i < 64; ++i)
        out[uint8_t(digits[i])] = i;
    return out;
}

// Bytes in turn, whatever they are written in.
class ByteSource {
  public:
    ByteSource(const std::string& text, size_t begin, size_t end, bool base64, const Location& where)
        : text_(&text), position_(begin), end_(end), base64_(base64), where_(&where) {}

    void take(std::byte* out, size_t count) {
        if (!base64_) {
            if (end_ - position_ < count) refuseShort(count, end_ - position_);
            std::memcpy(out, text_->data() + position_, count);
            position_ += count;
            return;
        }
        for (size_t done = 0; done < count;) {
            if (given_ == held_ && !nextGroup()) refuseShort(count, done);
            const size_t some = std::min(count - done, size_t(held_ - given_));
            std::memcpy(out + done, group_ + given_, some);
            given_ += int(some);
            done += some;
        }
    }

    // The most that can follow.
    size_t left() const { return base64_ ? (end_ - position_) / 4 * 3 + 3 : end_ - position_; }

    // Whether all bytes were taken and only white space follows. Padding holds no bytes.
    bool isAtEnd() {
        while (position_ < end_ && isSpace((*text_)[position_]))
            ++position_;
        return position_ == end_ && given_ == held_;
    }

  private:
    [[noreturn]] void refuseShort(size_t count, size_t found) const {
        throw Error(*where_, "the data end too early: expected ", count, " bytes more, found ", found);
    }

    // Four digits: one to three bytes. A padded group may be followed by another stream.
    bool nextGroup() {
        static constexpr std::array<uint8_t, 256> digits = base64Digits();
        uint32_t bits = 0;
        int count = 0, padding = 0;
        while (count + padding < 4) {
            while (position_ < end_ && isSpace((*text_)[position_]))
                ++position_;
            if (position_ == end_) {
                if (count + padding == 0) return false;
                throw Error(*where_, "the base64 text ends within a group of four");
            }
            const char c = (*text_)[position_];
            const uint8_t digit = digits[uint8_t(c)];
            if (c == '=' && count >= 2) {
                ++padding;
            } else if (digit == notADigit || padding > 0) {
                throw Error(*where_, "holds what is not base64");
            } else {
                bits |= uint32_t(digit) << (18 - 6 * count);
                ++count;
            }
            ++position_;
        }
        for (int i = 0; i < 3; ++i)
            group_[i] = std::byte(bits >> (16 - 8 * i) & 0xff);
        given_ = 0;
        held_ = count - 1;
        return true;
    }

    const std::string* text_;
    size_t position_, end_;
    bool base64_;
    const Location* where_;
    std::byte group_[3]{};
    int given_ = 0, held_ = 0;
};

uint64_t takeLength(ByteSource& source, const VtkEncoding& encoding) {
    std::byte bytes[8];
    const size_t size = encoding.longHeader ? 8 : 4;
    source.take(bytes, size);
    uint64_t out = 0;
    for (size_t i = 0; i < size; ++i)
        out |= uint64_t(bytes[encoding.bigEndian ? size - 1 - i : i]) << (8 * i);
    return out;
}

[[noreturn]] void refuseCount(uint64_t found, size_t expected, const Location& where) {
    throw Error(where, "holds ", found, " bytes, the extent takes ", expected);
}

// Each block is a stream of zlib's.
std::vector<std::byte> inflateBlocks(ByteSource& source, const VtkEncoding& encoding, size_t expected,
                                     const Location& where) {
    const uint64_t blocks = takeLength(source, encoding), blockBytes = takeLength(source, encoding),
                   lastBytes = takeLength(source, encoding);
    // Each is checked before they are multiplied, so that the product cannot overflow.
    if (blocks == 0 || blocks > expected || (blocks > 1 && blockBytes > expected) || lastBytes > blockBytes)
        throw Error(where, "the header of the compressed data tells of ", blocks, " blocks of ", blockBytes,
                    " bytes and a last of ", lastBytes, ", the extent takes ", expected);
    const uint64_t total = (blocks - 1) * blockBytes + (lastBytes ? lastBytes : blockBytes);
    if (total != expected) refuseCount(total, expected, where);
    std::vector<uint64_t> sizes;
    for (uint64_t i = 0; i < blocks; ++i)
        sizes.push_back(takeLength(source, encoding));

    std::vector<std::byte> out(expected), packed;
    for (uint64_t i = 0; i < blocks; ++i) {
        const uint64_t bytes = i + 1 == blocks && lastBytes ? lastBytes : blockBytes;
        if (sizes[i] > source.left())
            throw Error(where, "the data end too early: block ", i, " has ", sizes[i], " bytes, at most ",
                        source.left(), " are left");
        packed.resize(sizes[i]);
        source.take(packed.data(), packed.size());
        uLongf got = uLongf(bytes);
        const int code = uncompress(reinterpret_cast<Bytef*>(out.data() + i * blockBytes), &got,
                                    reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size()));
        if (code != Z_OK || got != bytes)
            throw Error(where, "block ", i, " of the compressed data is damaged");
    }
    return out;
}

}  // namespace

std::vector<std::byte> vtkBytes(const std::string& text, size_t begin, size_t end,
                                const VtkEncoding& encoding, size_t expected, const Location& where) {
    ByteSource source(text, begin, end, encoding.base64, where);
    if (encoding.zlib) return inflateBlocks(source, encoding, expected, where);
    const uint64_t bytes = takeLength(source, encoding);
    if (bytes != expected) refuseCount(bytes, expected, where);
    // before as much is reserved
    if (bytes > source.left())
        throw Error(where, "the data end too early: expected ", bytes, " bytes, at most ", source.left(),
                    " are left");
    std::vector<std::byte> out(expected);
    source.take(out.data(), out.size());
    return out;
}

}  // namespace shoal
