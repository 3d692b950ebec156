// Text that others wrote (names in files, names of files, what drivers and commands say) as it may be shown:
// nothing in it commands a terminal, hides, or turns the order of what stands around it.
//
// Control characters (C0, DEL and C1), those that set a direction of writing, and separators of lines become
// an escape as in JSON, such as \u001b; a byte that is no UTF-8 becomes \xff. So JSON that passes through
// stays the JSON that it was.
#pragma once

#include <cstdint>
#include <streambuf>
#include <string>
#include <string_view>

namespace shoal {

// The character at the text's beginning. `bytes` is at least 1; code is nothing where they are no UTF-8.
struct Utf8 {
    static constexpr uint32_t nothing = 0xffffffff;
    uint32_t code = nothing;
    size_t bytes = 1;
};
Utf8 firstCharacter(std::string_view text);
// Whether it is escaped.
bool hides(uint32_t code);
// \u001b
std::string escape(uint32_t code);

// On one line: line breaks and tabs are escaped, too.
std::string printable(std::string_view text);
// Line breaks stay where the next line is indented, as we write them and no name begins a line.
std::string printableLines(std::string_view text);
// Indents all lines but the first of what another program says, and drops white space at its end.
std::string indented(std::string_view text);

// Stands before a stream's buffer while it lives: what is written to the stream, whoever writes it, reaches
// its buffer printable, with its line breaks and tabs.
class PrintableStream : public std::streambuf {
  public:
    explicit PrintableStream(std::ostream& stream);
    ~PrintableStream() override;
    PrintableStream(const PrintableStream&) = delete;
    PrintableStream& operator=(const PrintableStream&) = delete;

  protected:
    int overflow(int c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;

  private:
    bool put(std::string_view text, bool whole);

    std::ostream& stream_;
    std::streambuf* to_;
    std::string begun_;  // a character of which not all bytes have come
};

}  // namespace shoal
