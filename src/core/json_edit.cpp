#include "core/json_edit.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

namespace shoal {

namespace {

using Kind = JsonValue::Kind;

bool holdsContainers(const JsonValue& array) {
    return array.kind == Kind::array &&
           std::any_of(array.items.begin(), array.items.end(), std::mem_fn(&JsonValue::isContainer));
}

// Returns the white space at the start of a position's line, up to that position.
std::string indentAt(const std::string& text, size_t position) {
    const size_t newline = position == 0 ? std::string::npos : text.rfind('\n', position - 1);
    const size_t line = newline == std::string::npos ? 0 : newline + 1;
    const size_t word = std::min(text.find_first_not_of(" \t", line), position);
    return text.substr(line, word - line);
}

// A value as writeJson writes it, its further lines behind `indent`.
std::string indented(const JsonValue& value, const std::string& indent, bool element) {
    std::string line = writeJsonLine(value);
    if (!value.isContainer() || (element && indent.size() + line.size() < 110)) return line;
    const std::string plain = writeJson(value);
    std::string out;
    for (const char c : plain.substr(0, plain.size() - 1)) {
        out += c;
        if (c == '\n') out += indent;
    }
    return out;
}

// One element or member that stands in the text, and what becomes of it.
struct Part {
    size_t begin = 0, end = 0;  // with its key
    bool kept = true;
    std::vector<std::string> added = {};  // behind it: elements, or keys with values
};

// An array or object of the text whose parts are kept, left out or added to.
class Edited {
  public:
    Edited(const std::string& text, const JsonValue& original) : text_(&text), original_(&original) {
        for (const JsonValue& item : original.items)
            parts_.push_back({item.begin, item.end});
        for (const auto& [key, value] : original.members)
            parts_.push_back({value.keyBegin, value.end});
    }

    bool empty() const { return parts_.empty(); }
    void leaveOut(size_t part) { parts_[part].kept = false; }
    // Behind a part, or at the front.
    void add(std::optional<size_t> behind, const std::string& key, const JsonValue& value) {
        const std::string word = key.empty() ? "" : writeJsonLine(JsonValue::makeString(key)) + ": ";
        const bool element = original_->kind == Kind::array;
        std::string written = ownLines() ? indented(value, indentAt(*text_, parts_.front().begin), element)
                                         : writeJsonLine(value);
        (behind ? parts_[*behind].added : front_).push_back(word + written);
    }

    void finish(std::vector<TextChange>& changes) const {
        const bool none = std::none_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.kept; });
        if (none) return replaceAll(changes);
        const size_t first = firstKept();
        addFront(first, changes);
        size_t end = parts_[first].end;  // of the part before that is kept
        for (size_t i = first; i < parts_.size(); ++i) {
            if (i > first && !parts_[i].kept) changes.push_back({parts_[i - 1].end, parts_[i].end, {}});
            if (parts_[i].kept) end = parts_[i].end;
            for (const std::string& word : parts_[i].added)
                changes.push_back({end, end, separator() + word});
        }
    }

  private:
    bool ownLines() const {
        return !parts_.empty() &&
               text_->substr(original_->begin, parts_.front().begin - original_->begin).find('\n') !=
                   std::string::npos;
    }
    std::string separator() const {
        return ownLines() ? ",\n" + indentAt(*text_, parts_.front().begin) : ", ";
    }
    size_t firstKept() const {
        size_t first = 0;
        while (!parts_[first].kept)
            ++first;
        return first;
    }
    // In front of the first that is kept, over those before it.
    void addFront(size_t first, std::vector<TextChange>& changes) const {
        std::string inserted;
        const auto put = [&](const std::vector<std::string>& words) {
            for (const std::string& word : words)
                inserted += word + separator();
        };
        put(front_);
        for (size_t i = 0; i < first; ++i)
            put(parts_[i].added);
        if (first > 0 || !inserted.empty())
            changes.push_back({parts_.front().begin, parts_[first].begin, inserted});
    }
    void replaceAll(std::vector<TextChange>& changes) const {
        std::vector<std::string> words = front_;
        for (const Part& part : parts_)
            words.insert(words.end(), part.added.begin(), part.added.end());
        const bool lines = ownLines() && !words.empty();
        const bool array = original_->kind == Kind::array;
        std::string inserted = array ? "[" : "{", between;
        if (lines) inserted += "\n" + indentAt(*text_, parts_.front().begin);
        for (const std::string& word : words) {
            inserted += between + word;
            between = separator();
        }
        if (lines) inserted += "\n" + indentAt(*text_, original_->end - 1);
        changes.push_back({original_->begin, original_->end, inserted + (array ? "]" : "}")});
    }

    const std::string* text_;
    const JsonValue* original_;
    std::vector<Part> parts_;
    std::vector<std::string> front_;
};

void replace(const std::string& text, const JsonValue& original, const JsonValue& after,
             std::vector<TextChange>& changes) {
    changes.push_back({original.begin, original.end, indented(after, indentAt(text, original.begin), false)});
}

// Where two arrays, equal at their ends, begin to differ, and how many elements of each do.
struct Difference {
    size_t first = 0, before = 0, after = 0;
};

Difference differenceOf(const std::vector<JsonValue>& before, const std::vector<JsonValue>& after) {
    Difference out;
    const size_t shorter = std::min(before.size(), after.size());
    while (out.first < shorter && sameJson(before[out.first], after[out.first]))
        ++out.first;
    size_t last = 0;
    while (last < shorter - out.first &&
           sameJson(before[before.size() - 1 - last], after[after.size() - 1 - last]))
        ++last;
    out.before = before.size() - out.first - last;
    out.after = after.size() - out.first - last;
    return out;
}

void changeArray(const std::string& text, const JsonValue& original, const JsonValue& before,
                 const JsonValue& after, std::vector<TextChange>& changes) {
    const Difference difference = differenceOf(before.items, after.items);
    Edited edited(text, original);
    const size_t common = std::min(difference.before, difference.after), first = difference.first;
    for (size_t i = first; i < first + common; ++i)
        addChanges(text, original.items[i], before.items[i], after.items[i], changes);
    for (size_t i = first + common; i < first + difference.before; ++i)
        edited.leaveOut(i);
    const size_t position = first + common;
    for (size_t i = position; i < first + difference.after; ++i)
        edited.add(position > 0 ? std::optional<size_t>(position - 1) : std::nullopt, "", after.items[i]);
    edited.finish(changes);
}

std::optional<size_t> indexOf(const JsonValue& object, const std::string& key) {
    for (size_t i = 0; i < object.members.size(); ++i)
        if (object.members[i].first == key) return i;
    return {};
}

void changeObject(const std::string& text, const JsonValue& original, const JsonValue& before,
                  const JsonValue& after, std::vector<TextChange>& changes) {
    Edited edited(text, original);
    for (size_t i = 0; i < original.members.size(); ++i) {
        const std::string& key = original.members[i].first;
        if (before.find(key) && !after.find(key)) edited.leaveOut(i);
    }
    // a new one stands behind the one that it follows in `after`, else at the end
    std::optional<size_t> behind;
    if (!edited.empty()) behind = original.members.size() - 1;
    for (const auto& [key, value] : after.members) {
        const JsonValue* old = before.find(key);
        const std::optional<size_t> index = indexOf(original, key);
        if (index) behind = index;
        if (old && sameJson(*old, value)) continue;
        if (!index) {
            edited.add(behind, key, value);
            continue;
        }
        const JsonValue& existing = original.members[*index].second;
        if (old)
            addChanges(text, existing, *old, value, changes);
        else if (!sameJson(existing, value))
            replace(text, existing, value, changes);
    }
    edited.finish(changes);
}

}  // namespace

bool sameJson(const JsonValue& a, const JsonValue& b) {
    if (a.kind != b.kind || a.items.size() != b.items.size() || a.members.size() != b.members.size())
        return false;
    for (size_t i = 0; i < a.items.size(); ++i)
        if (!sameJson(a.items[i], b.items[i])) return false;
    for (size_t i = 0; i < a.members.size(); ++i)
        if (a.members[i].first != b.members[i].first || !sameJson(a.members[i].second, b.members[i].second))
            return false;
    if (a.kind == Kind::number) return a.number == b.number;
    if (a.kind == Kind::string) return a.text == b.text;
    return a.kind != Kind::boolean || a.boolean == b.boolean;
}

void addChanges(const std::string& text, const JsonValue& original, const JsonValue& before,
                const JsonValue& after, std::vector<TextChange>& changes) {
    if (sameJson(before, after)) return;
    const bool kinds = original.kind == before.kind && before.kind == after.kind;
    if (kinds && after.kind == Kind::object) return changeObject(text, original, before, after, changes);
    const bool elements = kinds && after.kind == Kind::array && original.items.size() == before.items.size();
    if (elements && (holdsContainers(before) || holdsContainers(after)))
        return changeArray(text, original, before, after, changes);
    replace(text, original, after, changes);
}

void addArrayChanges(const std::string& text, const JsonValue& original, const JsonValue& before,
                     const JsonValue& after, const std::vector<int>& origins,
                     std::vector<TextChange>& changes) {
    Edited edited(text, original);
    std::vector<bool> kept(before.items.size());
    std::optional<size_t> behind;  // the last one that was there
    for (size_t i = 0; i < after.items.size(); ++i) {
        if (origins[i] < 0) {
            edited.add(behind, "", after.items[i]);
            continue;
        }
        behind = size_t(origins[i]);
        kept[*behind] = true;
        addChanges(text, original.items[*behind], before.items[*behind], after.items[i], changes);
    }
    for (size_t i = 0; i < kept.size(); ++i)
        if (!kept[i]) edited.leaveOut(i);
    edited.finish(changes);
}

std::string withChanges(const std::string& text, std::vector<TextChange> changes) {
    std::stable_sort(changes.begin(), changes.end(), [](const TextChange& a, const TextChange& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
    });
    std::string out;
    size_t position = 0;
    for (const TextChange& change : changes) {
        out.append(text, position, change.begin - position);
        out += change.replacement;
        position = change.end;
    }
    return out.append(text, position);
}

// ---- Merging

namespace {

// Compares members; null stands for one that is missing.
bool sameMember(const JsonValue* a, const JsonValue* b) {
    return a && b ? sameJson(*a, *b) : a == b;
}

bool allOf(Kind kind, const JsonValue& a, const JsonValue& b, const JsonValue& c) {
    return a.kind == kind && b.kind == kind && c.kind == kind;
}

bool isOfObjects(const JsonValue& array) {
    return std::all_of(array.items.begin(), array.items.end(),
                       [](const JsonValue& item) { return item.kind == Kind::object; });
}

// Returns the names of an array's objects, which are fewer where some have none of their own.
std::set<std::string> namesOf(const JsonValue& array) {
    std::set<std::string> out;
    for (const JsonValue& item : array.items)
        if (const JsonValue* name = item.find("name")) out.insert(name->text);
    return out;
}

bool isNamed(const JsonValue& array) {
    return namesOf(array).size() == array.items.size();
}

const JsonValue* named(const JsonValue& array, const std::string& name) {
    for (const JsonValue& item : array.items)
        if (item.find("name")->text == name) return &item;
    return nullptr;
}

class Merger {
  public:
    Merger(Prefer prefer, std::vector<std::string>& conflicts) : prefer_(prefer), conflicts_(conflicts) {}

    JsonValue merge(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs,
                    const std::string& path) {
        if (allOf(Kind::object, base, mine, theirs)) return mergeObjects(base, mine, theirs, path);
        const bool objects = allOf(Kind::array, base, mine, theirs) && isOfObjects(base) &&
                             isOfObjects(mine) && isOfObjects(theirs);
        if (objects && isNamed(base) && isNamed(mine) && isNamed(theirs))
            return mergeNamed(base, mine, theirs, path);
        if (!objects || base.items.size() != mine.items.size() || base.items.size() != theirs.items.size())
            return *choose(&base, &mine, &theirs, path);
        JsonValue out = JsonValue::makeArray();
        for (size_t i = 0; i < base.items.size(); ++i)
            out.items.push_back(
                merge(base.items[i], mine.items[i], theirs.items[i], concat(path, "[", i, "]")));
        return out;
    }

  private:
    // Null: it is not there.
    const JsonValue* choose(const JsonValue* base, const JsonValue* mine, const JsonValue* theirs,
                            const std::string& path) {
        if (sameMember(mine, base)) return theirs;
        if (sameMember(theirs, base) || sameMember(mine, theirs)) return mine;
        conflicts_.push_back(path);
        return prefer_ == Prefer::mine ? mine : theirs;
    }

    // Returns a member or element as both leave it; nothing: it is not there any more.
    std::optional<JsonValue> mergeOne(const JsonValue* base, const JsonValue* mine, const JsonValue* theirs,
                                      const std::string& path) {
        if (base && mine && theirs) return merge(*base, *mine, *theirs, path);
        const JsonValue* chosen = choose(base, mine, theirs, path);
        return chosen ? std::optional(*chosen) : std::nullopt;
    }

    // These two keep the order of `theirs`, which is on disk.
    JsonValue mergeObjects(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs,
                           const std::string& path) {
        JsonValue out = JsonValue::makeObject();
        for (const JsonValue* side : {&theirs, &mine})
            for (const auto& [key, value] : side->members) {
                if (out.find(key)) continue;
                const auto result =
                    mergeOne(base.find(key), mine.find(key), theirs.find(key), path + "." + key);
                if (result) out.add(key, *result);
            }
        return out;
    }
    JsonValue mergeNamed(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs,
                         const std::string& path) {
        JsonValue out = JsonValue::makeArray();
        std::set<std::string> done;
        for (const JsonValue* side : {&theirs, &mine})
            for (const JsonValue& item : side->items) {
                const std::string& name = item.find("name")->text;
                if (!done.insert(name).second) continue;
                const auto result = mergeOne(named(base, name), named(mine, name), named(theirs, name),
                                             concat(path, "[\"", name, "\"]"));
                if (result) out.items.push_back(*result);
            }
        return out;
    }

    Prefer prefer_;
    std::vector<std::string>& conflicts_;
};

}  // namespace

JsonValue merged(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs, Prefer prefer,
                 const std::string& path, std::vector<std::string>& conflicts) {
    return Merger(prefer, conflicts).merge(base, mine, theirs, path);
}

}  // namespace shoal
