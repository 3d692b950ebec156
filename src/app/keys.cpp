// `shoal keys`: what files may say, from the descriptions that their readers go by.
#include <algorithm>
#include <iostream>

#include "app/commands.h"
#include "core/description_schema.h"
#include "molecule/rules.h"
#include "scene/field_files/read_raw.h"
#include "scene/scene.h"

namespace shoal::app {

namespace {

// An object that a file can hold, and where: "scene.groups[].emitters[]".
struct Place {
    std::string path;
    const Description* object;
    const Description* variant = nullptr;  // whose word chose this one; its keys stand beside it
};

void addPlaces(std::vector<Place>& out, const Place& place);

void addWithin(std::vector<Place>& out, const std::string& path, const Description& object) {
    for (const Key& key : object.keys()) {
        const std::string inner = concat(path, ".", key.name);
        if (key.kind == Key::Kind::object) addPlaces(out, {inner, key.objects[0]});
        if (key.kind == Key::Kind::list) addPlaces(out, {inner + "[]", key.objects[0]});
        if (key.kind != Key::Kind::variant) continue;
        for (const Description* one : key.objects)
            addPlaces(out, {concat(path, ", ", key.name, " \"", one->name(), "\""), one, &object});
    }
}

void addPlaces(std::vector<Place>& out, const Place& place) {
    out.push_back(place);
    addWithin(out, place.path, *place.object);
}

std::vector<Place> allPlaces() {
    std::vector<Place> out;
    addPlaces(out, {"scene", &describe(static_cast<const Scene*>(nullptr))});
    addPlaces(out, {"molecule", &describe(static_cast<const Molecule*>(nullptr))});
    addPlaces(out, {"molecule.defaults", &describeDefaults()});
    addPlaces(out, {"layout", &describe(static_cast<const RawLayout*>(nullptr))});
    return out;
}

void print(const Key& key, const Description& of) {
    std::cout << "  " << key.name << ": " << typeText(key) << "; " << usualText(key, of) << "\n      "
              << meaningOf(key) << "\n";
}

void print(const Place& place) {
    std::cout << place.path << "\n  " << place.object->sentence() << "\n\n";
    for (const Key& key : place.object->keys())
        print(key, *place.object);
    std::cout << "\n";
}

// The name of the last key on the way, or the word of a variant.
bool isNamed(const Place& place, const std::string& name) {
    const size_t dot = place.path.find_last_of('.');
    std::string last = dot == std::string::npos ? place.path : place.path.substr(dot + 1);
    if (place.variant) last = place.object->name();
    if (last.ends_with("[]")) last.resize(last.size() - 2);
    return last == name || place.object->name() == name;
}

}  // namespace

int keysCommand(const Options& options) {
    const std::vector<Place> places = allPlaces();
    if (options.files.empty()) {
        for (const Place& place : places)
            std::cout << place.path << ": " << place.object->sentence() << "\n";
        std::cout << "\n`shoal keys NAME` prints the keys of an object, or every key of that name.\n";
        return 0;
    }
    for (const std::string& name : options.files) {
        bool found = false;
        std::vector<std::string> known;
        for (const Place& place : places) {
            if (isNamed(place, name)) print(place);
            found |= isNamed(place, name);
            known.push_back(place.object->name());
        }
        for (const Place& place : places) {
            const Key* key = found ? nullptr : place.object->find(name);
            for (const Key& other : place.object->keys())
                known.push_back(other.name);
            if (!key) continue;
            std::cout << place.path << "\n";
            print(*key, *place.object);
            std::cout << "\n";
        }
        const bool any = found || std::find(known.begin(), known.end(), name) != known.end();
        if (!any) throw WrongUse(concat("no file says \"", name, "\"", suggestion(name, known)));
    }
    return 0;
}

}  // namespace shoal::app
