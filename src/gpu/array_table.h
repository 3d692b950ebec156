// What a subsystem keeps on the GPU, as a table of text among the shaders (shaders/contact/arrays.txt): from
// it come the arrays themselves (gpu/arrays.h) and what shaders declare of them.
//
// A shader names what it reads and what it writes; a name counts once, wherever it stands:
//
//   #pragma reads places counts   the last stage's values: placesAt(slot), countsAt(slot)
//   #pragma writes totals         the own element's: putTotals(slot, k, value), putAllTotals(slot, values)
//   #pragma updates marks         both; atomics take marksBuffer[slot]. It stands before what reads it
//
// With buffers a lane writes where it likes, into at most 8 arrays (Program). In fragments `writes` makes the
// outputs of the pass, whose targets follow from their names (Program::written); of an array that has a value
// for each entry of a list a pass writes some entries, from `firstEntry` on, and calls putEntries() at its
// end.
//
// So that a pass has one text for both forms and all scenes, fragments only read what it updates, and an
// array that the form or the scene lacks takes nothing: it reads as zeros, and what is put into it goes
// nowhere. The same holds of what a pass declares for some scenes or for one form only:
//
//   #pragma writes effectiveCounts when !spreads
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "gpu/buffer.h"

namespace shoal::gpu {

struct ArrayRow {
    enum class Start { undefined, zero, far };  // far: w is 1e30
    std::string name;
    Texel texel = Texel::float4;  // what a value is
    int packed = 1;               // values a texel
    int count = 1;                // values of an element
    bool ofList = false;          // one for each entry of the element's list instead
    std::string index;            // what an element is of: "slot"; "given": the caller has the content
    size_t more = 0;              // elements behind the last
    bool isRecord = false;        // words in a storage block that shaders declare by themselves
    Start start = Start::undefined;
    std::vector<std::string> when;  // what a scene must have, or with ! must not, to need it
    bool isNeeded = true;           // by the scene
};

class ArrayTable {
  public:
    enum class Form { buffers, textures };
    // Reads the rows of a form. `holds`: what the scene has, as `when` names it; the form is added. Error,
    // located: a row that cannot be read; two of one name.
    ArrayTable(const std::string& file, Form form, std::set<std::string> holds = {});

    Form form() const { return form_; }
    const std::map<std::string, ArrayRow, std::less<>>& rows() const { return rows_; }
    // The includes that declarations need.
    const std::vector<std::string>& includes() const { return includes_; }
    const ArrayRow* find(std::string_view name) const;
    // The row of an array that the other form alone has or the scene does not need, or null.
    const ArrayRow* findAbsent(std::string_view name) const;
    // Whether the scene has all that these name, and nothing that they name with !.
    bool meets(const std::vector<std::string>& when) const;
    // Error, located: there is no such row.
    const ArrayRow& row(std::string_view name, const Location& asker) const;

  private:
    void readRow(const std::vector<std::string>& cells, const Location& where);

    std::string file_;
    Form form_;
    std::set<std::string> holds_;
    std::map<std::string, ArrayRow, std::less<>> rows_, elsewhere_;
    std::vector<std::string> includes_;
};

// What one shader has declared so far.
class ArrayDeclarations {
  public:
    static constexpr int drawBuffers = 8;  // that OpenGL 3.3 promises

    explicit ArrayDeclarations(const ArrayTable& table) : table_(&table) {}

    // The text in place of #pragma reads, writes or updates with these words: names and, after "when", what
    // the scene must have. Error, located: it is none of the three; no such array; it is read by all after
    // some have updated it.
    std::string declare(const std::string& verb, const std::vector<std::string>& words,
                        const Location& where);
    const std::vector<std::string>& written() const { return written_; }
    const std::vector<std::string>& updated() const {
        return updated_;
    }  // those of them that it reads as well

  private:
    std::string reading(const ArrayRow& row);
    std::string absent(const ArrayRow& row, const std::string& verb);
    std::string nowhere(const ArrayRow& row);
    std::string block(const ArrayRow& row, bool alsoReads);
    std::string outputs(const std::vector<const ArrayRow*>& rows);
    std::string withStride(const ArrayRow& row);

    const ArrayTable* table_;
    // nowhere_: what is put into them; zeros_: they are updated elsewhere, and read as zeros here
    std::set<std::string> read_, nowhere_, zeros_;
    std::vector<std::string> written_, updated_;
    int location_ = 0;
    bool hasStride_ = false;
};

}  // namespace shoal::gpu
