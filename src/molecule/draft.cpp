#include "molecule/draft.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "core/json_edit.h"
#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"
#include "molecule/skin.h"

namespace shoal {

namespace {

std::vector<int> upTo(size_t count) {
    std::vector<int> out(count);
    std::iota(out.begin(), out.end(), 0);
    return out;
}

// The value that most have; `fallback` where there are none.
template <typename Element>
double usual(const std::vector<Element>& elements, double Element::*number, double fallback) {
    const auto [value, count] = commonest(elements, number);
    return count > 0 ? value : fallback;
}

template <typename T>
void removeFrom(std::vector<T>& elements, const std::set<int>& which) {
    size_t kept = 0;
    for (size_t i = 0; i < elements.size(); ++i)
        if (!which.contains(int(i))) {
            if (kept != i) elements[kept] = std::move(elements[i]);
            ++kept;
        }
    elements.resize(kept);
}

// The indices of those that touch one of the vertices.
template <typename Element, typename Ends>
std::set<int> touching(const std::vector<Element>& elements, const std::set<int>& vertices, Ends ends) {
    std::set<int> out;
    for (size_t i = 0; i < elements.size(); ++i)
        for (const int end : ends(elements[i]))
            if (vertices.contains(end)) out.insert(int(i));
    return out;
}

}  // namespace

Draft::Draft(Molecule read) : molecule(std::move(read)) {
    origins = {upTo(molecule.vertices.size()), upTo(molecule.springs.size()), upTo(molecule.bends.size()),
               upTo(molecule.triangles.size())};
}

int addVertex(Draft& draft, const glm::dvec3& position) {
    Vertex vertex;
    vertex.position = position;
    vertex.mass = usual(draft.molecule.vertices, &Vertex::mass, 0.01);
    draft.molecule.vertices.push_back(vertex);
    draft.origins.vertices.push_back(-1);
    return int(draft.molecule.vertices.size()) - 1;
}

int springBetween(const Molecule& molecule, int a, int b) {
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Spring& spring = molecule.springs[i];
        if ((spring.a == a && spring.b == b) || (spring.a == b && spring.b == a)) return int(i);
    }
    return -1;
}

int addSpring(Draft& draft, int a, int b) {
    if (a == b) return -1;
    const int existing = springBetween(draft.molecule, a, b);
    if (existing >= 0) return existing;
    Spring spring;
    spring.a = a;
    spring.b = b;
    spring.stiffness = usual(draft.molecule.springs, &Spring::stiffness, 10);
    spring.damping = usual(draft.molecule.springs, &Spring::damping, 0.01);
    draft.molecule.springs.push_back(spring);
    draft.origins.springs.push_back(-1);
    return int(draft.molecule.springs.size()) - 1;
}

int addTriangle(Draft& draft, int a, int b, int c) {
    const std::set<int> corners = {a, b, c};
    if (corners.size() < 3) return -1;
    for (const Triangle& t : draft.molecule.triangles)
        if (std::set<int>{t.a, t.b, t.c} == corners) return -1;
    draft.molecule.triangles.push_back({a, b, c});
    draft.origins.triangles.push_back(-1);
    return int(draft.molecule.triangles.size()) - 1;
}

void removeSprings(Draft& draft, const std::set<int>& springs) {
    removeFrom(draft.molecule.springs, springs);
    removeFrom(draft.origins.springs, springs);
}

void removeBends(Draft& draft, const std::set<int>& bends) {
    removeFrom(draft.molecule.bends, bends);
    removeFrom(draft.origins.bends, bends);
}

void removeTriangles(Draft& draft, const std::set<int>& triangles) {
    removeFrom(draft.molecule.triangles, triangles);
    removeFrom(draft.origins.triangles, triangles);
}

void removeVertices(Draft& draft, const std::set<int>& vertices) {
    Molecule& m = draft.molecule;
    removeSprings(draft, touching(m.springs, vertices, [](const Spring& s) {
                      return std::vector<int>{s.a, s.b};
                  }));
    removeBends(draft, touching(m.bends, vertices, [](const Bend& b) {
                    return std::vector<int>{b.a, b.b, b.c, b.d};
                }));
    removeTriangles(draft, touching(m.triangles, vertices, [](const Triangle& t) {
                        return std::vector<int>{t.a, t.b, t.c};
                    }));
    std::vector<int> moved(m.vertices.size());
    int next = 0;
    for (size_t i = 0; i < moved.size(); ++i)
        moved[i] = vertices.contains(int(i)) ? -1 : next++;
    removeFrom(m.vertices, vertices);
    removeFrom(draft.origins.vertices, vertices);
    const auto follow = [&moved](int& index) { index = moved[size_t(index)]; };
    for (Spring& spring : m.springs)
        follow(spring.a), follow(spring.b);
    for (Bend& bend : m.bends)
        follow(bend.a), follow(bend.b), follow(bend.c), follow(bend.d);
    for (Triangle& t : m.triangles)
        follow(t.a), follow(t.b), follow(t.c);
    if (!m.skin.empty()) rebindSkin(m);
}

std::vector<int> mirrored(const Molecule& molecule, int axis) {
    std::vector<int> out(molecule.vertices.size(), -1);
    const double near = 1e-3 * molecule.size();
    for (size_t i = 0; i < out.size(); ++i) {
        glm::dvec3 image = molecule.vertices[i].position;
        image[axis] = -image[axis];
        double best = near;
        for (size_t j = 0; j < out.size(); ++j) {
            const double distance = glm::distance(image, molecule.vertices[j].position);
            if (distance > best) continue;
            best = distance;
            out[i] = int(j);
        }
    }
    return out;
}

std::string problemOf(const Molecule& molecule) {
    try {
        parseMolecule(writeMolecule(molecule), molecule.file);
        return {};
    } catch (const Error& error) {
        return concat(error.location().path, ": ", error.message());
    }
}

// ---- Saving

namespace {

constexpr const char* arrays[] = {"vertices", "springs", "bends", "triangles"};

const std::vector<int>& originsOf(const Draft& draft, std::string_view key) {
    return key == "vertices"  ? draft.origins.vertices
           : key == "springs" ? draft.origins.springs
           : key == "bends"   ? draft.origins.bends
                              : draft.origins.triangles;
}

JsonValue without(const JsonValue& object, const std::set<std::string>& keys) {
    JsonValue out = object;
    std::erase_if(out.members, [&](const auto& member) { return keys.contains(member.first); });
    return out;
}

JsonValue* find(JsonValue& object, const std::string& key) {
    for (auto& [name, value] : object.members)
        if (name == key) return &value;
    return nullptr;
}

// Where all kept elements that take a value from the defaults have the same new one, changes the default
// instead of each of them. `before` and `after` are both rewritten to say so.
void liftDefault(const char* array, const char* key, const JsonValue& root, const std::vector<int>& origins,
                 JsonValue& before, JsonValue& after) {
    const JsonValue *defaults = root.find("defaults"), *original = root.find(array);
    const JsonValue* given = defaults ? defaults->find(key) : nullptr;
    JsonValue *old = find(before, array), *current = find(after, array);
    if (!given || !original || !old || !current) return;
    std::vector<std::pair<JsonValue*, JsonValue*>> takers;
    for (size_t i = 0; i < current->items.size(); ++i) {
        if (origins[i] < 0 || original->items[size_t(origins[i])].find(key)) continue;
        takers.emplace_back(find(old->items[size_t(origins[i])], key), find(current->items[i], key));
    }
    if (takers.size() < 2) return;
    const double value = takers.front().second->number;
    for (const auto& [from, to] : takers)
        if (to->number != value) return;
    if (value == given->number) return;
    for (const auto& [from, to] : takers)
        *from = *to;
    const auto say = [key](JsonValue& side, double number) {
        JsonValue* all = find(side, "defaults");
        if (!all) all = &side.add("defaults", JsonValue::makeObject()).members.back().second;
        all->add(key, JsonValue::makeNumber(number));
    };
    say(before, given->number);
    say(after, value);
}

}  // namespace

std::string withEdits(const std::string& text, const Draft& draft) {
    const std::string& file = draft.molecule.file;
    const JsonValue root = parseJson(text, file);
    JsonValue before = toJson(parseMolecule(text, file), true), after = toJson(draft.molecule, true);
    for (const char* key : arrays) {
        const JsonValue* old = before.find(key);
        const std::vector<int>& origins = originsOf(draft, key);
        const int most = origins.empty() ? -1 : *std::max_element(origins.begin(), origins.end());
        if (most >= int(old ? old->items.size() : 0))
            throw Error(Location{file}, "has fewer ", key, " than when it was opened: nothing was saved");
    }
    liftDefault("vertices", "mass", root, draft.origins.vertices, before, after);
    liftDefault("springs", "stiffness", root, draft.origins.springs, before, after);
    liftDefault("springs", "damping", root, draft.origins.springs, before, after);

    std::vector<TextChange> changes;
    std::set<std::string> done;
    for (const char* key : arrays) {
        const JsonValue *original = root.find(key), *old = before.find(key), *current = after.find(key);
        if (!original || !old || !current) continue;
        addArrayChanges(text, *original, *old, *current, originsOf(draft, key), changes);
        done.insert(key);
    }
    addChanges(text, root, without(before, done), without(after, done), changes);
    std::string out = withChanges(text, std::move(changes));
    // no file is left that says something else, or that nobody can open
    if (!sameJson(toJson(parseMolecule(out, file), true), toJson(draft.molecule, true)))
        throw Error(Location{file}, "could not be changed in place: nothing was saved");
    return out;
}

}  // namespace shoal
