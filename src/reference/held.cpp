#include "reference/contact.h"

#include <algorithm>
#include <cmath>

namespace shoal::reference {

namespace {

// Where several surfaces hold a vertex at rest: rounds in which each answers the others, and the share of the
// force that may be left.
constexpr int rounds = 200;
constexpr double balanced = 1e-9;

glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& n) {
    return v - glm::dot(v, n) * n;
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

// Forces p along unit normals n with p_i + sum of p_j n_i.n_j = wanted_i. Of parallel surfaces the first
// acts.
std::array<double, 3> balance(const std::array<Surface, 3>& s, const std::array<double, 3>& wanted,
                              size_t count) {
    if (count == 1) return {wanted[0], 0, 0};
    const glm::dvec3 &a = s[0].normal, &b = s[1].normal;
    const double ab = glm::dot(a, b), det = 1 - ab * ab;
    if (count == 2) {
        if (det < 1e-12) return {wanted[0], 0, 0};
        return {(wanted[0] - ab * wanted[1]) / det, (wanted[1] - ab * wanted[0]) / det, 0};
    }
    const glm::dvec3& c = s[2].normal;
    const double ac = glm::dot(a, c), bc = glm::dot(b, c);
    const glm::dmat3 m(1, ab, ac, ab, 1, bc, ac, bc, 1);
    if (std::abs(glm::determinant(m)) < 1e-12) return balance(s, wanted, 2);
    const glm::dvec3 p = glm::inverse(m) * glm::dvec3(wanted[0], wanted[1], wanted[2]);
    return {p.x, p.y, p.z};
}

}  // namespace

bool Held::holds(size_t vertex, size_t collider) const {
    const Contacts& c = contacts_[vertex];
    return std::find(c.collider.begin(), c.collider.begin() + ptrdiff_t(c.count), collider) !=
           c.collider.begin() + ptrdiff_t(c.count);
}

void Held::hold(size_t vertex, size_t collider) {
    Contacts& c = contacts_[vertex];
    if (c.count == most || holds(vertex, collider)) return;
    c.grazes = false;
    if (c.count == 0) list_.push_back(vertex);
    c.collider[c.count++] = collider;
}

void Held::graze(size_t vertex, size_t collider) {
    if (any(vertex)) return;
    hold(vertex, collider);
    contacts_[vertex].grazes = true;
}

void Held::release(size_t vertex, size_t collider) {
    Contacts& c = contacts_[vertex];
    const auto end = c.collider.begin() + ptrdiff_t(c.count);
    const auto found = std::find(c.collider.begin(), end, collider);
    if (found == end) return;
    std::move(found + 1, end, found);
    c.sticks = false;
    if (--c.count == 0) releaseAll(vertex);
}

void Held::releaseAll(size_t vertex) {
    contacts_[vertex] = {};
    std::erase(list_, vertex);
}

bool Held::rough(const Contacts& c) const {
    for (size_t j = 0; j < c.count; ++j) {
        if (friction(c.collider[j]) > 0) return true;
    }
    return false;
}

void Held::keepDirections(const std::vector<glm::dvec3>& velocity) {
    for (const size_t i : list_) {
        if (velocity[i] != glm::dvec3(0)) contacts_[i].direction = unit(velocity[i]);
    }
}

// ---- forces

Held::Forces Held::forces(const Contacts& c, const glm::dvec3& x, const glm::dvec3& v,
                          const glm::dvec3& free) const {
    Forces out;
    std::array<double, most> wanted{};
    for (size_t j = 0; j < c.count; ++j) {
        out.surface[j] = surfaces_->under(c.collider[j], x);
        const RestSurfaces::Following f = surfaces_->following(c.collider[j], out.surface[j], x, v);
        out.shift[j] = f.shift;
        wanted[j] = -glm::dot(free, out.surface[j].normal) - f.turning;
    }
    out.pressure = balance(out.surface, wanted, c.count);
    return out;
}

Held::Reply Held::reply(const Contacts& c, const glm::dvec3& x, const glm::dvec3& free) const {
    Reply out{free, {}};
    std::array<glm::dvec3, most> normal, given{};
    for (size_t j = 0; j < c.count; ++j)
        normal[j] = surfaces_->under(c.collider[j], x).normal;
    for (int round = 0; round < (c.count == 1 ? 1 : rounds); ++round) {
        for (size_t j = 0; j < c.count; ++j) {
            const glm::dvec3 rest = out.acceleration - given[j], along = across(rest, normal[j]);
            out.pressure[j] = std::max(0.0, -glm::dot(rest, normal[j]));
            const double drive = glm::length(along), grip = friction(c.collider[j]) * out.pressure[j];
            const double share = drive <= grip ? 1 : grip / drive;
            given[j] = out.pressure[j] * normal[j] - share * along;
            out.acceleration = rest + given[j];
        }
    }
    return out;
}

double Held::pressure(size_t vertex, size_t collider, const glm::dvec3& x, const glm::dvec3& v,
                      const glm::dvec3& free) const {
    const Contacts& c = contacts_[vertex];
    const Forces f = forces(c, x, v, free);
    for (size_t j = 0; j < c.count; ++j) {
        if (c.collider[j] == collider && surfaces_->surfaceOf(collider, x).exists())
            return c.grazes ? f.shift[j] + restSpeed : f.pressure[j];
    }
    return -1;
}

double Held::friction(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free) const {
    const Contacts& c = contacts_[vertex];
    if (c.sticks || c.grazes) return 0;
    const Forces f = forces(c, x, v, free);
    double out = 0;
    for (size_t j = 0; j < c.count; ++j)
        out += friction(c.collider[j]) * std::max(f.pressure[j], 0.0);
    return out;
}

double Held::grip(size_t vertex, const glm::dvec3& x, const glm::dvec3& free) const {
    const Contacts& c = contacts_[vertex];
    if (c.count > 1) return balanced * glm::length(free) - glm::length(reply(c, x, free).acceleration);
    const glm::dvec3 n = surfaces_->under(c.collider[0], x).normal;
    return -friction(c.collider[0]) * glm::dot(free, n) - glm::length(across(free, n));
}

double Held::speedOff(size_t vertex, const glm::dvec3& x, const glm::dvec3& v) const {
    return glm::dot(v, surfaces_->under(contacts_[vertex].collider[0], x).normal);
}

// ---- how a vertex is held

void Held::classify(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free,
                    bool slipped) {
    if (v == glm::dvec3(0)) {
        classifyResting(vertex, x, free, slipped);
    } else {
        classifySliding(vertex, x, v, free);
    }
}

void Held::classifyResting(size_t vertex, const glm::dvec3& x, const glm::dvec3& free, bool slipped) {
    const Contacts before = contacts_[vertex];
    const Reply r = reply(before, x, free);
    const bool holds = glm::length(r.acceleration) <= balanced * glm::length(free);
    const bool sticks = holds && !slipped && (rough(before) || before.count == most);
    const glm::dvec3 n = surfaces_->under(before.collider[0], x).normal;
    contacts_[vertex].sticks = sticks;
    contacts_[vertex].direction = holds ? unit(across(free, n)) : unit(r.acceleration);
    if (sticks) return;
    for (size_t j = 0; j < before.count; ++j) {
        const bool pulls = glm::dot(r.acceleration, surfaces_->under(before.collider[j], x).normal) > 0 &&
                           r.pressure[j] == 0;
        if (pulls) release(vertex, before.collider[j]);
    }
}

void Held::classifySliding(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free) {
    contacts_[vertex].sticks = false;
    while (any(vertex)) {
        const Contacts c = contacts_[vertex];
        const Forces f = forces(c, x, v, free);
        const auto least = std::min_element(f.pressure.begin(), f.pressure.begin() + ptrdiff_t(c.count));
        const bool follows = c.count == 1 && !surfaces_->exact(c.collider[0]) && f.shift[0] > -restSpeed;
        if (c.grazes ? follows : !(*least < 0)) return;
        if (follows) {
            contacts_[vertex].grazes = true;
            return;
        }
        release(vertex, c.collider[size_t(least - f.pressure.begin())]);
    }
}

// ---- motion

void Held::constrain(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, glm::dvec3& rate,
                     glm::dvec3& acceleration) const {
    const Contacts& c = contacts_[vertex];
    if (c.sticks) {
        rate = acceleration = glm::dvec3(0);
        return;
    }
    const Forces f = forces(c, x, v, acceleration);
    double drag = 0;
    for (size_t j = 0; j < c.count; ++j) {
        if (!f.surface[j].exists()) continue;
        rate += f.shift[j] * f.surface[j].normal;
        if (c.grazes) return;
        acceleration += f.pressure[j] * f.surface[j].normal;
        drag += friction(c.collider[j]) * std::max(f.pressure[j], 0.0);
    }
    glm::dvec3 direction = v == glm::dvec3(0) ? c.direction : unit(v);
    if (glm::dot(direction, c.direction) < 0) direction = -direction;
    acceleration -= drag * direction;
}

void Held::project(size_t vertex, glm::dvec3& x, glm::dvec3& v) const {
    const Contacts& c = contacts_[vertex];
    if (c.sticks) return;
    for (size_t j = 0; j < c.count; ++j) {
        const Surface s = surfaces_->under(c.collider[j], x);
        if (!s.exists()) continue;
        x -= s.distance * s.normal;
        if (!c.grazes) v -= glm::dot(v, s.normal) * s.normal;
    }
}

}  // namespace shoal::reference
