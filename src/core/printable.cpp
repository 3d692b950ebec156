#include "core/printable.h"

#include <cstdio>
#include <ostream>

namespace shoal {

namespace {

// Returns the bytes of a UTF-8 character that begins with this one; 0: none does.
size_t bytesOf(unsigned char first) {
    return first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
}

std::string escapedByte(char byte) {
    char out[8];
    std::snprintf(out, sizeof out, "\\x%02x", unsigned(static_cast<unsigned char>(byte)));
    return out;
}

// `keeps(text, at)`: whether a character that hides stays as it is.
template <typename Keeps>
std::string shown(std::string_view text, const Keeps& keeps) {
    std::string out;
    out.reserve(text.size());
    for (size_t offset = 0; offset < text.size();) {
        const Utf8 character = firstCharacter(text.substr(offset));
        if (character.code == Utf8::nothing)
            out += escapedByte(text[offset]);
        else if (hides(character.code) && !keeps(text, offset))
            out += escape(character.code);
        else
            out += text.substr(offset, character.bytes);
        offset += character.bytes;
    }
    return out;
}

bool breaksOrTabs(std::string_view text, size_t offset) {
    return text[offset] == '\n' || text[offset] == '\t';
}

}  // namespace

Utf8 firstCharacter(std::string_view text) {
    const size_t bytes = text.empty() ? 0 : bytesOf(static_cast<unsigned char>(text[0]));
    if (bytes == 0 || text.size() < bytes) return {};
    if (bytes == 1) return {uint32_t(text[0]), 1};
    uint32_t code = static_cast<unsigned char>(text[0]) & (0xffu >> (bytes + 1));
    for (size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0) != 0x80) return {};
        code = code << 6 | (next & 0x3f);
    }
    constexpr uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    if (code < least[bytes] || code > 0x10ffff || surrogate) return {};
    return {code, bytes};
}

bool hides(uint32_t code) {
    const auto within = [code](uint32_t first, uint32_t last) { return code >= first && code <= last; };
    return code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) ||
           within(0x2028, 0x202e) || within(0x2066, 0x2069) || code == 0xfeff;
}

std::string escape(uint32_t code) {
    if (code == '\n') return "\\n";
    if (code == '\r') return "\\r";
    if (code == '\t') return "\\t";
    char out[16];
    std::snprintf(out, sizeof out, "\\u%04x", unsigned(code));
    return out;
}

std::string printable(std::string_view text) {
    return shown(text, [](std::string_view, size_t) { return false; });
}

std::string printableLines(std::string_view text) {
    return shown(text, [](std::string_view all, size_t offset) {
        return all[offset] == '\n' && all.substr(offset + 1).starts_with("  ");
    });
}

std::string indented(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += c == '\n' ? "\n  " : std::string(1, c);
    while (!out.empty() && (out.back() == ' ' || out.back() == '\n'))
        out.pop_back();
    return out;
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}

PrintableStream::~PrintableStream() {
    put({}, true);
    const std::ios_base::iostate state = stream_.rdstate();  // which a new buffer would clear
    stream_.rdbuf(to_);
    stream_.setstate(state & ~stream_.exceptions());
}

bool PrintableStream::put(std::string_view text, bool whole) {
    std::string all = begun_ + std::string(text);
    begun_.clear();
    for (size_t tail = 1; !whole && tail < 4 && tail <= all.size(); ++tail) {
        if (bytesOf(static_cast<unsigned char>(all[all.size() - tail])) <= tail) continue;
        begun_ = all.substr(all.size() - tail);
        all.resize(all.size() - tail);
        break;
    }
    const std::string out = shown(all, breaksOrTabs);
    return to_->sputn(out.data(), std::streamsize(out.size())) == std::streamsize(out.size());
}

int PrintableStream::overflow(int c) {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    return put({&character, 1}, false) ? c : traits_type::eof();
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
    return put({text, size_t(size)}, false) ? size : 0;
}

int PrintableStream::sync() {
    return to_->pubsync();
}

}  // namespace shoal
