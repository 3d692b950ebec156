#include "author/from_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "author/coarse.h"

namespace shoal {

namespace {

using Marks = std::vector<bool>;  // of welded vertices

bool readNumber(std::string_view& text, double& out) {
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (code != std::errc() || !std::isfinite(out)) return false;
    text.remove_prefix(size_t(end - text.data()));
    return true;
}

bool mark(Marks& marks, const Mesh& mesh, const PinRule& rule) {
    const double low = mesh.low[rule.axis], extent = mesh.high[rule.axis] - low;
    const double limit = rule.metres ? rule.limit : low + rule.limit * extent;
    // up to rounding: y<0 means the lowest vertices, too
    const double slack = 1e-9 * glm::distance(mesh.low, mesh.high);
    bool any = false;
    for (size_t v = 0; v < marks.size(); ++v) {
        const double coordinate = mesh.weldedPositions[v][rule.axis];
        if (rule.below ? coordinate > limit + slack : coordinate < limit - slack) continue;
        marks[v] = any = true;
    }
    return any;
}

bool markName(Marks& marks, const Mesh& mesh, const std::string& name) {
    bool any = false;
    const auto take = [&](int first, int count) {
        for (int t = first; t < first + count; ++t)
            for (int i = 0; i < 3; ++i)
                marks[size_t(mesh.weld[size_t(mesh.triangles[size_t(t)][i])])] = true;
        any = true;
    };
    for (const Mesh::Object& object : mesh.objects)
        if (object.name == name) take(object.firstTriangle, object.triangleCount);
    for (const Mesh::Part& part : mesh.parts)
        if (part.mesh == name || part.material == name) take(part.firstTriangle, part.triangleCount);
    for (size_t corner = 0; corner < mesh.bones.size(); ++corner)
        if (const int bone = mesh.bones[corner]; bone >= 0 && mesh.boneNames[size_t(bone)] == name)
            marks[size_t(mesh.weld[corner])] = any = true;
    return any;
}

bool markPaint(Marks& marks, const Mesh& mesh, const glm::dvec3& paint) {
    constexpr double near = 0.3;  // in each channel
    bool any = false;
    for (size_t v = 0; v < mesh.colors.size(); ++v) {
        const glm::dvec3 d = glm::abs(mesh.colors[v] - paint);
        if (std::max({d.x, d.y, d.z}) <= near) marks[size_t(mesh.weld[v])] = any = true;
    }
    return any;
}

std::string namesIn(const Mesh& mesh) {
    std::vector<std::string> all;
    const auto add = [&](const std::string& name) {
        for (const std::string& known : all)
            if (known == name) return;
        if (!name.empty()) all.push_back(name);
    };
    for (const Mesh::Object& object : mesh.objects)
        add(object.name);
    for (const Mesh::Part& part : mesh.parts)
        add(part.mesh), add(part.material);
    for (const std::string& bone : mesh.boneNames)
        add(bone);
    std::string out;
    for (size_t i = 0; i < all.size() && i < 12; ++i)
        out += (i ? ", " : "") + all[i];
    return all.size() > 12 ? out + ", ..." : out;
}

}  // namespace

std::vector<bool> pinnedOf(const Mesh& mesh, const PinChoice& choice) {
    Marks marks(mesh.weldedPositions.size());
    for (const PinRule& rule : choice.rules)
        if (!mark(marks, mesh, rule)) throw Error("no vertex of the mesh meets ", rule.text);
    for (const std::string& name : choice.names)
        if (!markName(marks, mesh, name))
            throw Error("the mesh has no object, mesh, material or bone \"", name, "\"; it has ",
                        namesIn(mesh));
    if (!choice.paints.empty() && mesh.colors.empty())
        throw Error("the mesh has no vertex colours to find pins by");
    for (const std::string& paint : choice.paints)
        if (!markPaint(marks, mesh, parsePaint(paint)))
            throw Error("no vertex of the mesh is painted ", paint);
    return marks;
}

PinRule parsePinRule(const std::string& text) {
    PinRule rule;
    rule.text = text;
    std::string_view rest = text;
    const size_t axis = rest.empty() ? std::string::npos : std::string_view("xyz").find(rest[0]);
    bool sound = axis != std::string::npos && rest.size() > 2 && (rest[1] == '<' || rest[1] == '>');
    if (sound) {
        rule.axis = int(axis);
        rule.below = rest[1] == '<';
        rest.remove_prefix(2);
        sound = readNumber(rest, rule.limit) && (rest.empty() || rest == "m");
        rule.metres = rest == "m";
    }
    if (!sound)
        throw Error("expected a rule such as y<0.1, in shares of the box, or y<0.02m, in metres; found \"",
                    text, "\"");
    return rule;
}

// Three numbers with commas between them; false: something else.
static bool readThree(std::string_view text, glm::dvec3& out) {
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && (text.empty() || text[0] != ',')) return false;
        if (i > 0) text.remove_prefix(1);
        if (!readNumber(text, out[i])) return false;
    }
    return text.empty();
}

glm::dvec3 parsePinPoint(const std::string& text) {
    glm::dvec3 out(0);
    if (readThree(text, out)) return out;
    throw Error("expected a point in shares of the box, such as 0.5,1,0.5; found \"", text, "\"");
}

glm::dvec3 parsePaint(const std::string& text) {
    static const std::vector<std::string> names = {"red",  "green",   "blue",  "yellow",
                                                   "cyan", "magenta", "white", "black"};
    static const glm::dvec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                        {0, 1, 1}, {1, 0, 1}, {1, 1, 1}, {0, 0, 0}};
    for (size_t i = 0; i < names.size(); ++i)
        if (text == names[i]) return colors[i];
    glm::dvec3 out(0);
    if (readThree(text, out) && glm::clamp(out, 0.0, 1.0) == out) return out;
    throw Error("expected a colour such as red, or three numbers from 0 to 1 such as 1,0.5,0; found \"", text,
                "\"", suggestion(text, names));
}

std::vector<bool> choosePins(const Mesh& mesh, const CoarseMesh& coarse, const PinChoice& choice) {
    std::vector<bool> pinned(coarse.positions.size());
    if (!choice.any()) return pinned;
    for (const glm::dvec3& point : choice.points) {
        const glm::dvec3 place = glm::mix(mesh.low, mesh.high, point);
        const auto nearer = [&](const glm::dvec3& a, const glm::dvec3& b) {
            return glm::distance(a, place) < glm::distance(b, place);
        };
        const auto nearest = std::min_element(coarse.positions.begin(), coarse.positions.end(), nearer);
        pinned[size_t(nearest - coarse.positions.begin())] = true;
    }
    const Marks marks = pinnedOf(mesh, choice);
    if (std::find(marks.begin(), marks.end(), true) == marks.end()) return pinned;
    std::vector<int> marked(pinned.size()), all(pinned.size());
    for (size_t v = 0; v < marks.size(); ++v) {
        ++all[size_t(coarse.map[v])];
        if (marks[v]) ++marked[size_t(coarse.map[v])];
    }
    const auto share = [&](size_t c) { return all[c] > 0 ? double(marked[c]) / all[c] : 0; };
    bool any = false;
    size_t best = 0;
    for (size_t c = 0; c < pinned.size(); ++c) {
        const bool most = share(c) > 0.5;
        pinned[c] = pinned[c] || most;
        any = any || most;
        if (share(c) > share(best)) best = c;
    }
    if (!any) pinned[best] = true;
    return pinned;
}

}  // namespace shoal
