#include "core/json_merge.h"

#include <algorithm>

#include "core/json_edit.h"

namespace shoal {

namespace {

using Kind = JsonValue::Kind;

// Compares members; null stands for one that is missing.
bool same(const JsonValue* a, const JsonValue* b) {
    return a && b ? sameJson(*a, *b) : a == b;
}

bool allOf(Kind kind, const JsonValue& a, const JsonValue& b, const JsonValue& c) {
    return a.kind == kind && b.kind == kind && c.kind == kind;
}

bool elementwise(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs) {
    if (!allOf(Kind::array, base, mine, theirs)) return false;
    const auto objects = [](const JsonValue& array) {
        return std::all_of(array.items.begin(), array.items.end(),
                           [](const JsonValue& item) { return item.kind == Kind::object; });
    };
    return base.items.size() == mine.items.size() && base.items.size() == theirs.items.size() &&
           objects(base) && objects(mine) && objects(theirs);
}

class Merger {
  public:
    Merger(Prefer prefer, std::vector<std::string>& conflicts) : prefer_(prefer), conflicts_(conflicts) {}

    JsonValue merge(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs,
                    const std::string& path) {
        if (allOf(Kind::object, base, mine, theirs)) return mergeObjects(base, mine, theirs, path);
        if (!elementwise(base, mine, theirs)) return *choose(&base, &mine, &theirs, path);
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
        if (same(mine, base)) return theirs;
        if (same(theirs, base) || same(mine, theirs)) return mine;
        conflicts_.push_back(path);
        return prefer_ == Prefer::mine ? mine : theirs;
    }

    // In the order of `theirs`, which is on disk.
    JsonValue mergeObjects(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs,
                           const std::string& path) {
        JsonValue out = JsonValue::makeObject();
        const auto add = [&](const std::string& key) {
            if (out.find(key)) return;
            const JsonValue *b = base.find(key), *m = mine.find(key), *t = theirs.find(key);
            const std::string inner = path + "." + key;
            if (b && m && t) {
                out.add(key, merge(*b, *m, *t, inner));
            } else if (const JsonValue* chosen = choose(b, m, t, inner)) {
                out.add(key, *chosen);
            }
        };
        for (const auto& [key, value] : theirs.members)
            add(key);
        for (const auto& [key, value] : mine.members)
            add(key);
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
