#include "scene/field_kinds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/describe.h"
#include "scene/field_files/field_file.h"
#include "scene/noise_tile.h"

namespace shoal {

template class Boxed<FieldShape>;

constexpr double turn = 2 * std::numbers::pi;

static bool isFar(const glm::dvec3& way) {
    constexpr double most = 1024;  // m: floats up to there are at most 6e-5 m apart
    const glm::dvec3 size = glm::abs(way);
    return std::max({size.x, size.y, size.z}) > most;
}

// Returns how many periods it is from `origin` to a point near `near`, along each of three directions that
// are square to one another; none where that is not far. The columns are the periods, m.
static glm::dvec3 periodsTo(const glm::dvec3& near, const glm::dvec3& origin, const glm::dmat3& periods) {
    const glm::dvec3 way = near - origin;
    glm::dvec3 out(0);
    for (int i = 0; isFar(way) && i < 3; ++i)
        out[i] = std::round(glm::dot(way, periods[i]) / glm::dot(periods[i], periods[i]));
    return out;
}

// The cell of a lattice that `count` cells lead to; beyond 2^32 the lattice repeats, as its hash does.
static std::string cellText(const glm::dvec3& count) {
    const glm::uvec3 cell{glm::vec<3, int64_t>(count)};
    return concat("uvec3(", cell.x, "u, ", cell.y, "u, ", cell.z, "u)");
}

const Description& describe(const UniformField*) {
    static const Description description =
        Describe<UniformField>("uniform", "The same velocity everywhere, and at all times.")
            .key("velocity", &UniformField::velocity, {"m/s", "The velocity."})
            .needed();
    return description;
}

GlslCalls UniformField::calls(const glm::dvec3&) const {
    return {GlslCall("vec3").vector(velocity)};
}

const Description& describe(const OscillatingField*) {
    using F = OscillatingField;
    static const Description description =
        Describe<F>("oscillating",
                    "The same everywhere, to and fro. It is velocity · sin(2π · frequency · t + phase).")
            .key("velocity", &F::velocity, {"m/s", "The velocity at the peak."})
            .needed()
            .key("frequency", &F::frequency, {"Hz", "How often it goes to and fro.", Range::atLeast(0)})
            .needed()
            .key("phase", &F::phase, {"rad", "The phase at the start."});
    return description;
}

GlslCalls OscillatingField::calls(const glm::dvec3&) const {
    return {GlslCall("oscillatingVelocity")
                .time()
                .vector(velocity)
                .number(turn * frequency)
                .clock({.rate = turn * frequency, .start = phase})};
}

static const std::vector<std::string> noiseForms = {"table", "computed"};
static const Says saysNoise = {
    "", "Whether the noise is read from a table that repeats, which is fast, or computed at every place."};

const Description& describe(const GustField*) {
    using F = GustField;
    static const Description description =
        Describe<F>(
            "gust",
            "Fronts of stronger and weaker wind that travel along a direction. It is direction · speed · "
            "(1 + strength · n), with n a noise of mean 0, about within [−1, 1], at ((s − frontSpeed · t) / "
            "length, p / width, q / width); s is along the direction, p and q across it.")
            .direction("direction", &F::direction, {"", "The direction of the wind."})
            .key("speed", &F::speed, {"m/s", "The mean speed."})
            .key("strength", &F::strength, {"", "The relative variation of the speed.", Range::atLeast(0)})
            .key("length", &F::length, {"m", "The size of a front along the direction.", aboveZero()})
            .key("width", &F::width, {"m", "The size of a front across the direction.", aboveZero()})
            .key("frontSpeed", &F::frontSpeed, {"m/s", "The speed of the fronts along the direction."})
            .key("seed", &F::seed, {"", "The seed of the noise."})
            .word("noise", &F::noise, noiseForms, saysNoise);
    return description;
}

GlslCalls GustField::calls(const glm::dvec3& near) const {
    const glm::dvec3 along = glm::normalize(direction);
    // an axis across: horizontal unless the wind blows vertically
    const glm::dvec3 up = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(up, along)), third = glm::cross(along, across);
    if (noise == NoiseForm::computed) {
        const glm::dmat3 cells(along * length, across * width, third * width);
        const glm::dvec3 passed = periodsTo(near, glm::dvec3(0), cells);
        return {GlslCall("gustVelocity")
                    .place(cells * passed)
                    .time()
                    .vector(along)
                    .vector(across)
                    .number(speed)
                    .number(strength)
                    .number(frontSpeed)
                    .pair({length, width})
                    .clock({.kind = FieldClock::Kind::cells, .rate = frontSpeed / length})
                    .text(concat(seed, "u"))
                    .text(cellText(passed))};
    }
    const NoiseTile tile = noiseTile(0);
    const double tileLength = length * tile.cells.x, tileWidth = width * tile.cells.y;
    const glm::dmat3 tiles(along * tileLength, across * tileWidth, third * tileWidth);
    const glm::dvec3 passed = periodsTo(near, glm::dvec3(0), tiles);
    return {
        GlslCall("gustFromTile")
            .tile(tile)
            .place(tiles * passed)
            .time()
            .vector(along * speed)
            .vector(along * speed * strength)
            .vector(along / tileLength)
            .vector(across / tileWidth)
            .vector(third / tileWidth)
            .number(frontSpeed / tileLength)
            .clock({.kind = FieldClock::Kind::cells, .rate = frontSpeed / tileLength, .start = 0 - passed.x})
            .text(concat(seed, "u"))};
}

// The rows of the gradient, which glm stores as columns.
static void readGradient(JsonReader& r, ShearField& field, void*) {
    r.require("gradient");
    const JsonValue* rows = r.raw("gradient");
    std::vector<double> numbers;
    if (rows->kind == JsonValue::Kind::array)
        for (const JsonValue& row : rows->items)
            if (row.kind == JsonValue::Kind::array && row.items.size() == 3)
                for (const JsonValue& entry : row.items)
                    if (entry.kind == JsonValue::Kind::number) numbers.push_back(entry.number);
    if (numbers.size() != 9 || rows->items.size() != 3)
        throw Error(r.locate("gradient"), "expected three rows of three numbers");
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            field.gradient[column][row] = numbers[size_t(3 * row + column)];
}

const Description& describe(const ShearField*) {
    using F = ShearField;
    static const auto rule = [](const F& field, const Where& where) {
        for (int i = 0; i < 9; ++i)
            needWithin(where.locate("gradient"), field.gradient[i / 3][i % 3], {});
    };
    static const Description description =
        Describe<F>("shear", "A velocity that grows evenly. It is velocity + gradient · (x − origin).")
            .byHand("gradient", {.value = Form::Value::number, .lists = {{3, 3}, {3, 3}}},
                    {"three rows of three numbers, 1/s", "The gradient of the velocity."}, readGradient)
            .needed()
            .key("origin", &F::origin, {"m", "Where the velocity is as given."})
            .key("velocity", &F::velocity, {"m/s", "The velocity at the origin."})
            .rule(rule);
    return description;
}

GlslCalls ShearField::calls(const glm::dvec3& near) const {
    const glm::dmat3 rows = glm::transpose(gradient);
    const glm::dvec3 way = isFar(near - origin) ? near - origin : glm::dvec3(0);
    return {GlslCall("shearVelocity")
                .from(origin + way)
                .vector(velocity + gradient * way)
                .vector(rows[0])
                .vector(rows[1])
                .vector(rows[2])};
}

const Description& describe(const VortexField*) {
    using F = VortexField;
    static const Description description =
        Describe<F>(
            "vortex",
            "Turns about an axis, anticlockwise seen from its tip. With r the distance from it and R the "
            "radius it is speed · 2 (r/R) / (1 + (r/R)²) around it and lift / (1 + (r/R)²) along it.")
            .key("origin", &F::origin, {"m", "A point of the axis."})
            .direction("axis", &F::axis, {"", "The direction of the axis."})
            .key("speed", &F::speed, {"m/s", "The speed at the radius."})
            .key("radius", &F::radius, {"m", "The radius of the core.", aboveZero()})
            .key("lift", &F::lift, {"m/s", "The speed along the axis, on it."});
    return description;
}

GlslCalls VortexField::calls(const glm::dvec3&) const {
    return {GlslCall("vortexVelocity")
                .from(origin)
                .vector(glm::normalize(axis))
                .number(speed)
                .number(radius)
                .number(lift)};
}

const Description& describe(const AbcField*) {
    using F = AbcField;
    static const Description description =
        Describe<F>("abc",
                    "Spirals that mix all (Arnold, Beltrami and Childress). It is (a sin kz + c cos ky, "
                    "b sin kx + a cos kz, c sin ky + b cos kx), with k = 2π / wavelength.")
            .key("origin", &F::origin, {"m", "Where the phases are 0."})
            .key("a", &F::a, {"m/s", "The first amplitude."})
            .key("b", &F::b, {"m/s", "The second amplitude."})
            .key("c", &F::c, {"m/s", "The third amplitude."})
            .key("wavelength", &F::wavelength, {"m", "The wavelength.", aboveZero()});
    return description;
}

GlslCalls AbcField::calls(const glm::dvec3& near) const {
    return {GlslCall("abcVelocity")
                .from(origin + wavelength * periodsTo(near, origin, glm::dmat3(wavelength)))
                .number(a)
                .number(b)
                .number(c)
                .number(turn / wavelength)};
}

const Description& describe(const TaylorGreenField*) {
    using F = TaylorGreenField;
    static const Description description =
        Describe<F>("taylorGreen",
                    "Cells that turn against their neighbours (Taylor and Green). It is "
                    "speed · (cos kx sin ky, −sin kx cos ky, 0) cos kz, with k = 2π / wavelength.")
            .key("origin", &F::origin, {"m", "Where the phases are 0."})
            .key("speed", &F::speed, {"m/s", "The largest speed."})
            .key("wavelength", &F::wavelength, {"m", "The wavelength.", aboveZero()});
    return description;
}

GlslCalls TaylorGreenField::calls(const glm::dvec3& near) const {
    return {GlslCall("taylorGreenVelocity")
                .from(origin + wavelength * periodsTo(near, origin, glm::dmat3(wavelength)))
                .number(speed)
                .number(turn / wavelength)};
}

const Description& describe(const CurlNoiseField*) {
    using F = CurlNoiseField;
    static const Description description =
        Describe<F>("curlNoise", "The curl of a noise in space and time: free of divergence, without a mean.")
            .key("speed", &F::speed, {"m/s", "About the RMS speed of one octave.", Range::atLeast(0)})
            .key("length", &F::length, {"m", "The size of the largest eddies.", aboveZero()})
            .key("period", &F::period, {"s", "The time in which they change.", aboveZero()})
            .key(
                "octaves", &F::octaves,
                {"", "How many octaves it has, each of half the length and period and 2^(−1/3) of the speed.",
                 Range::between(1, 4)})
            .key("seed", &F::seed, {"", "The seed of the noise."})
            .word("noise", &F::noise, noiseForms, saysNoise);
    return description;
}

GlslCalls CurlNoiseField::calls(const glm::dvec3& near) const {
    const FieldClock clock{.kind = FieldClock::Kind::cells, .rate = 1 / period};
    const std::string seedText = concat(seed, "u");
    if (noise == NoiseForm::computed) {
        const glm::dvec3 passed = periodsTo(near, glm::dvec3(0), glm::dmat3(length));
        return {GlslCall("curlNoiseVelocity")
                    .place(length * passed)
                    .time()
                    .number(speed)
                    .number(length)
                    .number(period)
                    .text(concat(octaves))
                    .clock(clock)
                    .text(seedText)
                    .text(cellText(passed))};
    }
    const NoiseTile tile = noiseTile(octaves);
    const glm::dmat3 tiles(length * tile.cells.x);
    return {GlslCall("curlNoiseFromTile")
                .tile(tile)
                .place(tiles * periodsTo(near, glm::dvec3(0), tiles))
                .time()
                .number(speed * tile.range / 511)
                .number(1 / (length * tile.cells.x))
                .number(1 / period)
                .number(momentDrift(octaves) / std::numbers::sqrt3 / tile.cells.x)
                .clock(clock)
                .text(seedText)};
}

GlslCalls GridField::calls(const glm::dvec3& near) const {
    GlslCall out(times.empty() ? "gridVelocity" : "gridSequenceVelocity");
    const glm::dmat3 boxes(high.x - low.x, 0, 0, 0, high.y - low.y, 0, 0, 0, high.z - low.z);
    out.from(wrap ? low + boxes * periodsTo(near, low, boxes) : low)
        .vector(glm::dvec3(resolution) / (high - low))
        .text(concat("ivec3(", resolution.x, ", ", resolution.y, ", ", resolution.z, ")"))
        .samples(values)
        .text(wrap ? "true" : "false");
    if (times.empty()) return {out};
    // The time in frames of the sequence, on from the one that was last passed when the frame began.
    const size_t frames = times.size();
    const double interval = (times.back() - times.front()) / double(frames - 1);
    bool even = true;
    for (size_t i = 0; i < frames; ++i)
        even = even && std::abs(times[i] - times.front() - double(i) * interval) < 1e-6 * interval;
    const FieldClock clock{
        .kind = FieldClock::Kind::frames, .times = times, .period = repeats ? period() : 0};
    GlslCall frame(even ? "placeEvenly" : "placeAmong");
    frame.clock(clock);
    if (even) {
        frame.number(1 / interval);
    } else {
        std::vector<double> intervals;
        for (size_t i = 0; i < frames; ++i)
            intervals.push_back((i + 1 < frames ? times[i + 1] : times.front() + period()) - times[i]);
        frame.numbers(intervals).text(concat(frames)).number(clock.period);
    }
    out.call(frame).text(concat(frames)).text(repeats ? "true" : "false");
    return {out};
}

const Description& describe(const WaveTrain*) {
    static const auto rule = [](const WaveTrain& train, const Where& where) {
        if (train.direction.x == 0 && train.direction.z == 0)
            throw Error(where.locate("direction"),
                        "expected a direction with a part along x or z: waves travel level");
        const double most = train.wavelength / (2 * std::numbers::pi);
        if (train.amplitude >= most)
            throw Error(where.locate("amplitude"), "expected less than ", most, " m: crests of ",
                        train.wavelength, " m length would curl over, found ", train.amplitude);
    };
    static const auto derive = [](WaveTrain& train, const Where&) {
        if (train.direction.x != 0 || train.direction.z != 0) train.direction.y = 0;
    };
    static const Description description =
        Describe<WaveTrain>("train", "One train of waves.")
            .key("direction", &WaveTrain::direction,
                 {"", "The direction of travel, of which only x and z count."})
            .key("amplitude", &WaveTrain::amplitude,
                 {"m",
                  "Half the height, below the depth and below wavelength / 2π, where crests would curl over.",
                  Range::atLeast(0)})
            .needed()
            .key("wavelength", &WaveTrain::wavelength, {"m", "The wavelength.", aboveZero()})
            .needed()
            .key("phase", &WaveTrain::phase, {"rad", "The phase at the origin at time 0."})
            .derive(derive)
            .rule(rule);
    return description;
}

const Description& describe(const WavesField*) {
    using F = WavesField;
    static const auto rule = [](const F& field, const Where& where) {
        constexpr size_t most = 32;
        const size_t count = field.trains.size();
        if (count == 0 || count > most)
            throw Error(where.locate("trains"), "expected 1 to ", most, " trains, found ", count);
        for (size_t i = 0; field.depth && i < count; ++i)
            if (field.trains[i].amplitude >= *field.depth)
                throw Error(where.in("trains", i).locate("amplitude"), "expected less than the depth of ",
                            *field.depth, " m, found ", field.trains[i].amplitude);
    };
    static const Description description =
        Describe<F>("waves", "The water under a sum of waves [Fournier 1986].")
            .key("origin", &F::origin, {"m", "A point of the still surface."})
            .key("depth", &F::depth,
                 {"m", "The depth of the bottom; without it the water is deep.", aboveZero()})
            .key("gravity", &F::gravity,
                 {"m/s²", "The gravity of the waves; the scene may have none.", aboveZero()})
            .key("trains", &F::trains, {"", "The trains of waves, 1 to 32, which add up."})
            .needed()
            .rule(rule, R"({"properties": {"trains": {"minItems": 1, "maxItems": 32}}})");
    return description;
}

GlslCalls WavesField::calls(const glm::dvec3& near) const {
    constexpr double deep = 1e9;  // m
    const double bottom = depth.value_or(deep);
    double top = 0;
    for (const WaveTrain& train : trains)
        top += train.amplitude;
    GlslCalls out;
    for (const WaveTrain& train : trains) {
        const double k = turn / train.wavelength, frequency = std::sqrt(gravity * k * std::tanh(k * bottom));
        const glm::dvec2 along = glm::normalize(glm::dvec2(train.direction.x, train.direction.z));
        // as good across, and never again above or below
        const glm::dmat3 waves(train.wavelength * glm::dvec3(along.x, 0, along.y), glm::dvec3(0, 1e30, 0),
                               train.wavelength * glm::dvec3(-along.y, 0, along.x));
        out.push_back(GlslCall("waveVelocity")
                          .from(origin + waves * periodsTo(near, origin, waves))
                          .time()
                          .pair(along)
                          .number(k)
                          .number(frequency)
                          .clock({.rate = -frequency, .start = train.phase})
                          .number(train.amplitude * frequency / -std::expm1(-2 * k * bottom))
                          .number(bottom)
                          .number(top));
    }
    return out;
}

const Description& describe(const HurricaneField*) {
    using F = HurricaneField;
    static const Description description =
        Describe<F>("hurricane", "The gradient wind of a hurricane [Holland 1980], with inflow and updraft.")
            .key("origin", &F::origin, {"m", "The eye at the ground."})
            .key("speed", &F::speed,
                 {"m/s",
                  "The largest speed at the ground, anticlockwise from above; a negative one is clockwise."})
            .key("radius", &F::radius, {"m", "The radius of the largest speed.", aboveZero()})
            .key("shape", &F::shape,
                 {"", "Holland's B: how peaked the profile is; 1 to 2.5 in nature.", Range::between(0.5, 3)})
            .key("inflow", &F::inflow,
                 {"rad", "The angle of the wind at the ground towards the axis.", Range::between(0, 1.2)})
            .key("height", &F::height, {"m", "The height above which there is no wind.", aboveZero()})
            .key("coriolis", &F::coriolis,
                 {"1/s", "The Coriolis parameter: 5e-5 at 20° of latitude.", Range::between(0, 1)});
    return description;
}

GlslCalls HurricaneField::calls(const glm::dvec3&) const {
    return {GlslCall("hurricaneVelocity")
                .from(origin)
                .number(speed)
                .number(radius)
                .number(shape)
                .number(std::tan(inflow))
                .number(height)
                .number(coriolis)};
}

const Description& describe(const Field*) {
    static const Description description =
        Describe<Field>("field", "A velocity of the fluid. Fields add up, and move what has drag.")
            .key("name", &Field::name, {"", "Its name in messages and in the panel; no two have the same."})
            .alternatives("type", &Field::shape, {"", "Which velocity it is."})
            .key("weight", &Field::weight, {"", "What multiplies the velocity."})
            .box("box", &Field::box, {"m", "The field has no effect outside this box."});
    return description;
}

const char* kindName(const FieldShape& shape) {
    return std::visit([](const auto& kind) { return describe(&kind).name().c_str(); }, shape);
}

}  // namespace shoal
