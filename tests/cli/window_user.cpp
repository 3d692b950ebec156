#include "cli/window_user.h"

#include <cstdlib>
#include <iostream>

#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

namespace shoal::test {

// $0 is a folder of the script's own, the rest is the program. The window adds a "." to $SHOAL_FRAMES
// whenever a frame begins with nothing left to take, and a "w" for a frame while the program is busy; what is
// drawn by panels that are new settles within the next two. Letters are the built-in ones, so that places do
// not depend on the machine's fonts.
static constexpr const char* prelude = R"(
set -e
dir=$0
export SHOAL_FRAMES="$dir/frames" FONTCONFIG_FILE="$dir/none"
: > "$dir/frames"
{
  code=0
  sh -c 'echo $$ > "$0/pid"; exec "$@"' "$dir" "$@" > "$dir/out" 2> "$dir/err" < /dev/null || code=$?
  echo $code > "$dir/code"
} &
trap 'gone || kill -9 $(cat "$dir/pid")' EXIT

gone() { [ -s "$dir/code" ]; }
frames() { tr -cd . < "$dir/frames" | wc -c; }
await() {
  end=$(($(date +%s) + ${limit:-60}))
  until eval "$1"; do
    [ $(date +%s) -lt $end ] || { echo "not within ${limit:-60} s: $1" >&2; exit 1; }
    sleep 0.02
  done
}
settle() {
  seen=$(($(frames) + 4))
  [ -n "$stopped" ] || await "gone || [ \$(frames) -ge $seen ]"
}
says() { await "[ \$(cat '$dir/out' '$dir/err' | grep -c -- '$1') -ge ${2:-1} ]"; }
at() { xdotool mousemove --window $w $1 $2; settle; }
press() { xdotool mousemove --window $w $1 $2 mousedown 1 mouseup 1; settle; }
drag() { xdotool mousemove --window $w $1 $2 mousedown 1 mousemove --window $w $3 $2 mouseup 1; settle; }
key() { xdotool keydown $1 keyup $1; settle; }
control() { xdotool keydown ctrl keydown $1 keyup $1 keyup ctrl; settle; }
inOneFrame() {
  kill -STOP $(cat "$dir/pid")
  stopped=yes
  eval "$1"
  stopped=
  kill -CONT $(cat "$dir/pid")
  settle
}
close() { for i in 1 2 3 4 5 6; do gone || key Escape; done; }

limit=300
await "gone || [ \$(frames) -ge 4 ]"
limit=60
w=$(xdotool search --onlyvisible --pid $(cat "$dir/pid") | head -n 1)
xdotool windowfocus $w
settle
)";

bool hasXdotool() {
    static const bool has = std::system("command -v xdotool > /dev/null 2>&1") == 0;
    if (!has) std::cerr << "xdotool is not installed: what the user does in the window is not tested\n";
    return has;
}

Outcome inWindow(const Words& arguments, const std::string& steps, const Surroundings& surroundings) {
    const Scratch scratch;
    Words words{"-c", prelude + steps + "\nawait gone\n", scratch.path(""), SHOAL_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Surroundings patient = surroundings;
    patient.seconds = 1200;  // the script has limits of its own
    const Outcome script = runProgram("/bin/sh", words, patient);
    const auto written = [&](const char* name) {
        return std::filesystem::exists(scratch / name) ? readFile(scratch.path(name)) : std::string();
    };
    Outcome out;
    out.out = written("out");
    out.err = withoutWaits(written("err"));
    const std::string code = written("code");
    if (!code.empty() && std::stoi(code) < 128) out.code = std::stoi(code);
    INFO(script.err << out.out << out.err);
    CHECK(script.code == 0);
    return out;
}

}  // namespace shoal::test
