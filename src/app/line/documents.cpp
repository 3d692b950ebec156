#include "app/line/cli.h"

#include <algorithm>

namespace shoal::app {

namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

// The words between which an option's value is chosen; its type names them: fused|ping-pong|auto.
std::string wordsOf(const CLI::Option& option) {
    std::string out = option.get_type_name();
    if (out.find('|') == std::string::npos) return {};
    std::replace(out.begin(), out.end(), '|', ' ');
    return out;
}

std::string describe(const CLI::Option& option) {
    const std::string& value = option.get_default_str();
    return option.get_description() + (value.empty() ? "" : " (default " + value + ")");
}

class Help : public CLI::Formatter {
    std::string make_option_opts(const CLI::Option* option) const override {
        if (option->get_type_size() == 0) return {};
        const bool several = option->get_expected_max() == CLI::detail::expected_max_vector_size;
        return " " + option->get_type_name() + (several ? " ..." : "");
    }
    std::string make_option_desc(const CLI::Option* option) const override { return describe(*option); }
    // One empty line between groups, not two.
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        return CLI::detail::find_and_replace(Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                             "\n\n");
    }
};

// ---- man

// As text: no line of it is a request, no hyphen becomes another character.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return out;
}

std::string valueOf(const CLI::Option& option) {
    if (option.get_type_size() == 0) return {};
    return " \\fI" + roff(option.get_type_name()) + "\\fR";
}

std::string optionEntry(const CLI::Option& option) {
    const bool positional = option.get_positional();
    std::string names = option.get_name(positional, !positional);
    for (size_t comma = 0; (comma = names.find(',', comma)) != std::string::npos; comma += 2)
        names.replace(comma, 1, ", ");
    return ".TP\n\\fB" + roff(names) + "\\fR" + (positional ? "" : valueOf(option)) + "\n" +
           roff(describe(option)) + "\n";
}

// A command and those below it.
void addCommand(std::string& out, const CLI::App& command, const std::string& name) {
    out += ".SS " + roff(name) + "\n" + roff(command.get_description()) + ".\n";
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional()) out += optionEntry(*option);
    for (const std::string& group : command.get_groups()) {
        std::string entries;
        for (const CLI::Option* option : command.get_options())
            if (option->nonpositional() && option->get_group() == group && option != command.get_help_ptr())
                entries += optionEntry(*option);
        if (!entries.empty() && !group.empty()) out += ".PP\n" + roff(group) + ":\n" + entries;
    }
    for (const CLI::App* below : commandsOf(command))
        addCommand(out, *below, name + " " + below->get_name());
}

// ---- Markdown

// Text in a cell of a table.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += (c == '|' || c == '<' ? "\\" : "") + std::string(1, c);
    return out;
}

// A command and those below it: a heading, then a row for each argument and option.
void addSection(std::string& out, const CLI::App& command, const std::string& name) {
    out += "\n## " + name + "\n\n" + command.get_description() + ".\n";
    std::string rows;
    for (const bool positional : {true, false})
        for (const CLI::Option* option : command.get_options()) {
            if (option->get_positional() != positional || option == command.get_help_ptr()) continue;
            std::string names = option->get_type_name();
            if (!positional) {
                if (option->get_type_size() == 0) names.clear();
                names = concat(option->get_name(false, true), names.empty() ? "" : " ", names);
            }
            rows += "| `" + cell(names) + "` | " + cell(describe(*option)) + " |\n";
        }
    if (!rows.empty()) out += "\n| option | meaning |\n|---|---|\n" + rows;
    for (const CLI::App* below : commandsOf(command))
        addSection(out, *below, name + " " + below->get_name());
}

// ---- bash

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> out;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        for (const std::string& name : option->get_lnames())
            out.push_back("--" + name);
    }
    return out;
}

// Adds the words that may follow an option, as a case of "command option".
void addValues(std::string& out, const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string words = wordsOf(*option);
        const bool takesFile = option->get_type_name() == "FILE" || option->get_type_name() == "TARGET" ||
                               option->get_type_name() == "FOLDER";
        if (!option->nonpositional() || option->get_type_size() == 0) continue;
        for (const std::string& flag : option->get_lnames())
            out += concat("    '", name, " --", flag, "') ",
                          !words.empty() ? concat("words='", words, "'")
                          : takesFile    ? "return"
                                         : "compopt +o default; return",
                          ";;\n");
    }
    for (const CLI::App* below : commandsOf(command))
        addValues(out, *below, name + " " + below->get_name());
}

// Adds the words that may stand where no option's value is due, as a case of the command.
void addWords(std::string& out, const CLI::App& command, const std::string& name) {
    std::vector<std::string> words = optionsOf(command);
    std::string scenes;
    for (const CLI::App* below : commandsOf(command))
        words.push_back(below->get_name());
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional()) continue;
        if (!wordsOf(*option).empty()) words.push_back(wordsOf(*option));
        if (option->get_type_name() == "SCENE") scenes = " scenes=yes";
    }
    out += "    '" + name + "') words='" + joined(words, " ") + "'" + scenes + ";;\n";
    for (const CLI::App* below : commandsOf(command))
        addWords(out, *below, name + " " + below->get_name());
}

void addNames(std::string& out, const CLI::App& command, const std::string& name) {
    for (const CLI::App* below : commandsOf(command)) {
        const std::string whole = name + " " + below->get_name();
        out += (out.empty() ? "'" : "|'") + whole + "'";
        addNames(out, *below, whole);
    }
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormat() {
    return std::make_shared<Help>();
}

std::string manPage(const CLI::App& app) {
    std::string out = ".TH SHOAL 1 \"\" \"" + roff(app.version()) + "\"\n.SH NAME\n" + app.get_name() +
                      " \\- " + roff(app.get_description().substr(app.get_description().find(": ") + 2)) +
                      "\n.SH SYNOPSIS\n.B " + app.get_name() +
                      "\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
    for (const CLI::App* command : commandsOf(app))
        addCommand(out, *command, app.get_name() + " " + command->get_name());
    return out + ".SH NOTES\n" + roff(app.get_footer()) + "\n";
}

std::string markdown(const CLI::App& app) {
    std::string out;
    for (const CLI::App* command : commandsOf(app))
        addSection(out, *command, app.get_name() + " " + command->get_name());
    return out;
}

std::string bashCompletion(const CLI::App& app) {
    std::string names, values, words;
    addNames(names, app, app.get_name());
    addValues(values, app, app.get_name());
    addWords(words, app, app.get_name());
    return R"sh(# Completion of shoal in bash, made from the declarations of its options. Where it has nothing to say, bash
# completes the names of files.
_shoal() {
    local current=${COMP_WORDS[COMP_CWORD]} command=shoal words= scenes= word name i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        case "$command $word" in
        )sh" +
           names + R"sh() command="$command $word" ;;
        esac
    done
    COMPREPLY=()
    case "$command ${COMP_WORDS[COMP_CWORD - 1]}" in
)sh" + values +
           R"sh(    *)
    case $command in
)sh" + words +
           R"sh(    esac
    esac
    # The words are ours. Names of scenes are those of files: text, of which nothing is expanded.
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    [[ $scenes && $current != -* ]] || return 0
    while read -r name _; do
        [[ $name == "$current"* ]] && COMPREPLY+=("$(printf %q "$name")")
    done < <("${COMP_WORDS[0]}" scenes 2>/dev/null)
    while IFS= read -r name; do
        COMPREPLY+=("$(printf %q "$name")")
    done < <(compgen -f -- "$current")
}
complete -o default -F _shoal shoal
)sh";
}

}  // namespace shoal::app
