// `shoal keys`: what files may say, from the descriptions that their readers go by.
#include <iostream>

#include "app/line/commands.h"
#include "core/description_text.h"
#include "scene/field_files/field_file.h"
#include "scene/scene.h"

namespace shoal::app {

namespace {

// An object that a file can hold: where, such as "scene.groups[].emitters[]", and the key that holds it, or
// the word of a variant.
struct Place {
    std::string path, name;
    const Description* object;
};

void addPlaces(std::vector<Place>& out, const Place& place) {
    out.push_back(place);
    for (const Key& key : place.object->keys()) {
        const bool variant = key.kind == Key::Kind::variant;
        const std::string inner = concat(place.path, variant ? ", " : ".", key.name);
        for (const Description* held : key.objects)
            if (variant)
                addPlaces(out, {concat(inner, " \"", held->name(), "\""), held->name(), held});
            else
                addPlaces(out, {concat(inner, key.kind == Key::Kind::list ? "[]" : ""), key.name, held});
    }
}

std::vector<Place> allPlaces() {
    std::vector<Place> out;
    addPlaces(out, {"scene", "scene", &describe(static_cast<const Scene*>(nullptr))});
    addPlaces(out, {"molecule", "molecule", &describe(static_cast<const Molecule*>(nullptr))});
    addPlaces(out, {"layout", "layout", &describe(static_cast<const RawLayout*>(nullptr))});
    return out;
}

void print(const Key& key, const Description& description) {
    std::cout << "  " << key.name << ": " << typeText(key) << "; " << usualText(key, description)
              << "\n      " << meaningOf(key) << "\n";
}

void print(const Place& place) {
    std::cout << place.path << "\n  " << place.object->sentence() << "\n\n";
    for (const Key& key : place.object->keys())
        print(key, *place.object);
    std::cout << "\n";
}

// Prints the objects of that name, else the keys of that name. Error: there is neither.
void printNamed(const std::vector<Place>& places, const std::string& name) {
    std::vector<std::string> known;
    bool found = false;
    for (const Place& place : places) {
        known.push_back(place.object->name());
        if (place.name != name && place.object->name() != name) continue;
        found = true;
        print(place);
    }
    if (found) return;
    for (const Place& place : places)
        for (const Key& key : place.object->keys()) {
            known.push_back(key.name);
            if (key.name != name) continue;
            found = true;
            std::cout << place.path << "\n";
            print(key, *place.object);
            std::cout << "\n";
        }
    if (!found) throw WrongUse(concat("no file says \"", name, "\"", suggestion(name, known)));
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
    for (const std::string& name : options.files)
        printNamed(places, name);
    return 0;
}

}  // namespace shoal::app
