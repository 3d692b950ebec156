// The expected verdict on each solver in each hard case. In the order of solvers():
// euler, verlet, leapfrog, rk4, xpbd, bdf2-xpbd, bdf2-corotated.
// On the ping-pong path the explicit ones do the same, and the implicit ones are refused.
#include <map>
#include <stdexcept>

#include "hard/outcome.h"

namespace shoal::test {

namespace {

constexpr Verdict P = Verdict::passes, R = Verdict::refuses, F = Verdict::fails;

const std::map<std::string, std::vector<Verdict>> table{
    {"harmonic spring, kicked", {P, P, P, P, P, P, P}},
    {"harmonic spring", {P, P, P, P, P, P, P}},
    {"damped spring", {P, P, P, P, P, P, P}},
    {"discrete recurrence", {P, P, P, P, P, P, P}},
    {"free fall", {P, P, P, P, P, P, P}},
    {"single vertex, ballistic", {P, P, P, P, P, P, P}},
    {"terminal velocity, gamma h 0.001 to 1", {P, P, P, P, P, P, P}},
    {"terminal velocity, gamma h 10 to 1e5", {P, P, P, R, P, P, P}},
    {"ABC advection", {P, P, P, P, P, P, P}},
    {"Taylor-Green stream function", {P, P, P, P, P, P, P}},
    {"rigid spin, 4 rad/s for 20 s", {P, P, P, P, F, P, P}},
    {"rigid spin, 21 rad/s for 20 s", {P, P, P, F, F, P, P}},
    {"rest shape, moved rigidly", {P, P, P, P, P, P, P}},
    {"Galilean shift", {P, P, P, P, P, P, P}},
    {"rotated world", {P, P, P, P, P, P, P}},
    {"100 km from the origin", {P, P, P, P, P, P, P}},
    {"pinned vertices keep their bits", {P, P, P, P, P, P, P}},
    {"a million steps, undamped", {P, P, P, P, F, F, F}},
    {"w h 0.1 to 1", {P, P, P, P, P, P, P}},
    {"w h 10 to 1000", {R, R, R, R, P, P, P}},
    {"mass ratio 1e6, w h 1.5", {P, P, P, P, P, P, P}},
    {"mass ratio 1e6, w h 19", {R, R, R, R, P, P, P}},
    {"frame hitch, same substeps", {F, F, F, F, P, P, P}},
    {"frame hitch, substepsNeeded", {P, P, P, P, P, P, P}},
    {"symmetric stretch of a square", {P, P, P, P, P, P, P}},
    {"symmetric stretch of a triangle", {P, P, P, P, F, F, F}},
    {"random, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"flat, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"inverted, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"stretched 10x, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"collapsed to 1e-3, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"kicked at 1 km/s, leaf, w h 0.3", {P, P, P, P, P, P, P}},
    {"random, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"flat, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"inverted, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"stretched 10x, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"collapsed to 1e-3, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"kicked at 1 km/s, leaf, w h 30", {R, R, R, R, P, P, P}},
    {"random, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"flat, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"inverted, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"stretched 10x, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"collapsed to 1e-3, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"kicked at 1 km/s, leaf, w h 1000", {R, R, R, R, P, P, P}},
    {"random, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"flat, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"inverted, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"stretched 10x, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"collapsed to 1e-3, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"kicked at 1 km/s, fish, w h 0.3", {P, P, P, P, P, P, P}},
    {"random, fish, w h 30", {R, R, R, R, P, P, P}},
    {"flat, fish, w h 30", {R, R, R, R, P, P, P}},
    {"inverted, fish, w h 30", {R, R, R, R, P, P, P}},
    {"stretched 10x, fish, w h 30", {R, R, R, R, P, P, P}},
    {"collapsed to 1e-3, fish, w h 30", {R, R, R, R, P, P, P}},
    {"kicked at 1 km/s, fish, w h 30", {R, R, R, R, P, P, P}},
    {"angular momentum, stretched leaf", {P, P, P, P, P, P, P}},
    {"angular momentum, stretched tetrahedron", {P, P, P, P, F, F, F}},
    {"coincident vertices", {P, P, P, P, P, P, P}},
    {"collinear molecule", {P, P, P, P, P, P, P}},
    {"degenerate triangle", {P, P, P, P, P, P, P}},
    {"bounce, restitution 0", {P, P, P, P, P, P, P}},
    {"bounce, restitution 0.25", {P, F, P, P, P, P, P}},
    {"bounce, restitution 0.5", {P, F, P, P, P, P, P}},
    {"bounce, restitution 0.75", {P, F, P, P, P, P, P}},
    {"bounce, restitution 1", {P, F, P, P, P, P, P}},
    {"incline of 15 degrees", {P, P, P, P, P, P, P}},
    {"incline of 26 degrees", {P, P, P, P, P, P, P}},
    {"incline of 28 degrees", {P, P, P, P, P, P, P}},
    {"incline of 45 degrees", {P, P, P, P, P, P, P}},
    {"resting point", {P, P, P, P, P, P, P}},
    {"resting tetrahedron", {P, P, P, P, P, P, P}},
    {"resting tetrahedron on a box", {P, P, P, P, P, P, P}},
    {"resting point under a load", {P, P, P, P, P, P, P}},
    {"200 m/s at a plane", {P, P, P, P, P, P, P}},
    {"200 m/s at a height field", {P, P, P, P, P, P, P}},
    {"200 m/s at a ball of 0.05 m", {P, P, P, P, P, P, P}},
    {"200 m/s at a box of 0.05 m", {P, F, P, P, P, P, P}},
    {"200 m/s at a turned box of 0.05 m", {P, F, P, P, P, P, P}},
    {"200 m/s at a capsule of 0.05 m", {P, F, P, P, P, P, P}},
    {"200 m/s between two boxes", {P, P, P, P, P, P, P}},
    {"bounce off a box, restitution 0.7", {P, F, P, P, P, P, P}},
    {"bounce off a capsule, restitution 0.7", {P, F, P, P, P, P, P}},
    {"groove of 40 degrees", {P, P, P, P, P, P, P}},
    {"groove of 90 degrees", {P, P, P, P, P, P, P}},
    {"groove of 140 degrees", {P, P, P, P, P, P, P}},
    {"boxes side by side", {P, P, P, P, P, P, P}},
    {"balls that overlap", {P, P, P, P, P, P, P}},
    {"points inside a ball", {P, P, P, P, P, P, P}},
    {"tetrahedra inside a ball", {P, P, P, P, P, P, P}},
    {"tetrahedra inside the ground", {P, F, P, P, P, P, P}},
    {"a floor that carries", {P, P, P, P, P, P, P}},
    {"stiff body, at rest", {R, R, R, R, P, P, P}},
    {"stiff body, flat", {R, R, R, R, P, P, P}},
    {"stiff body, on a corner", {R, R, R, R, P, P, P}},
    {"a lift", {P, P, P, P, P, P, P}},
    {"a paddle", {P, F, P, P, P, P, P}},
    {"a fast thin paddle", {P, P, P, P, P, P, P}},
    {"a turntable", {P, P, P, P, P, P, P}},
    {"height field, valley", {P, P, P, P, P, P, P}},
    {"height field, ridge", {P, P, P, P, P, P, P}},
    {"sphere, pole and middle", {P, P, P, P, P, P, P}},
    {"thin field, level", {P, P, P, P, P, P, P}},
    {"thin field, tilted", {P, P, P, P, P, P, P}},
    {"field of a mesh with holes", {P, P, P, P, P, P, P}},
    {"head-on pair, restitution 0", {P, P, P, P, P, P, P}},
    {"glancing pair, restitution 0", {P, P, P, P, P, P, P}},
    {"head-on pair, restitution 0.5", {P, P, P, P, P, P, P}},
    {"glancing pair, restitution 0.5", {P, P, P, P, P, P, P}},
    {"head-on pair, restitution 1", {P, P, P, P, P, P, P}},
    {"glancing pair, restitution 1", {P, P, P, P, P, P, P}},
    {"fast pair, head-on", {P, P, P, P, P, P, P}},
    {"fast pair, glancing", {P, P, P, P, P, P, P}},
    {"leaves meet at 5 m/s", {P, P, P, P, P, P, P}},
    {"a pile of tetrahedra comes to rest and stays", {P, P, P, P, P, P, P}},
    {"a pile of tetrahedra with `rest` stays to the bit", {P, P, P, P, P, P, P}},
    {"tetrahedra squeezed to half their room", {P, P, P, P, P, P, P}},
    {"marbles on a slope of 20 degrees stay", {P, P, P, P, P, P, P}},
    {"marbles on a slope of 32 degrees slide", {P, P, P, P, P, P, P}},
    {"a molecule starts inside another", {P, P, P, P, P, P, P}},
    {"a million contacts", {P, P, P, P, P, P, P}},
    {"contact of radius 1e-9 m", {P, P, P, P, P, P, P}},
};

}  // namespace

const std::vector<Verdict>& expectedOf(const std::string& name) {
    const auto row = table.find(name);
    if (row == table.end()) throw std::out_of_range(concat("no row of expected.cpp is \"", name, "\""));
    return row->second;
}

std::vector<std::string> expectedNames() {
    std::vector<std::string> out;
    for (const auto& [name, verdicts] : table)
        out.push_back(name);
    return out;
}

}  // namespace shoal::test
