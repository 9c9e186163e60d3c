#!/usr/bin/env python3
"""Manual pages, completions and the changelog of the package.

    documents.py PROGRAM VERSION FOLDER

FOLDER is made anew: man1/ has qchopper.1.gz and a page for each command, by help2man from --help; qchopper.bash,
_qchopper (zsh) and qchopper.fish complete commands and options, all from the table that `PROGRAM schema commands`
prints; doc/ has the changelog. The date is SOURCE_DATE_EPOCH (reproducible-builds.org), else that of CHANGELOG.md's
newest commit, else 0: the same sources give the same bytes.
"""

import email.utils
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CELLS = ("cells", "${XDG_CONFIG_HOME:-$HOME/.config}/qchopper/cells", "/usr/share/qchopper/cells")


def date_of_sources():
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given:
        return int(given)
    asked = subprocess.run(["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True, check=False)
    return int(asked.stdout) if asked.returncode == 0 and asked.stdout.strip() else 0


def write_packed(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(gzip.compress(text.encode(), compresslevel=9, mtime=0))


def command_table(program):
    return json.loads(subprocess.run([program, "schema", "commands"], capture_output=True, check=True).stdout)["commands"]


def manual_page(program, words, about, version, date):
    """Of one command; without words of the program itself. help2man takes the words as one program."""
    said = " ".join([str(program), *words])
    name = "-".join(["qchopper", *words])
    environment = dict(os.environ, SOURCE_DATE_EPOCH=str(date), LC_ALL="C.UTF-8")
    page = subprocess.run(
        ["help2man", "--no-info", "--no-discard-stderr", "--section=1", f"--version-string={version}",
         f"--name={about}", f"--source=QChopper {version}", "--manual=User Commands", said],
        env=environment, capture_output=True, text=True, check=True).stdout
    page = re.sub(r'^\.TH .*? "1"', f'.TH {name.upper()} "1"', page, count=1, flags=re.MULTILINE)
    # help2man names the page by the file that it called.
    page = re.sub(r"^(\.SH NAME\n)(.*?) \\- ", lambda m: f"{m[1]}{name} \\- ", page, count=1, flags=re.MULTILINE)
    also = "qchopper(1)" if words else "the manual pages qchopper-prepare(1) and of the other commands"
    return page + f".SH \"SEE ALSO\"\n{also}; /usr/share/doc/qchopper/user\n"


def bash_completion(table):
    below = {}
    for row in table:
        parent, _, last = row["command"].rpartition(" ")
        below.setdefault(parent, []).append(last)
    lines = ["# bash completion of qchopper, made of its table of commands", "_qchopper() {",
             '    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command="" words="" i',
             "    for ((i = 1; i < COMP_CWORD; ++i)); do",
             '        case "${command:+$command }${COMP_WORDS[i]}" in']
    every = "|".join(f'"{row["command"]}"' for row in table)
    lines += [f'            {every}) command="${{command:+$command }}${{COMP_WORDS[i]}}" ;;', "        esac", "    done",
              "    if [[ $previous == --cell ]]; then", "        local folder names=\"\"",
              "        for folder in " + " ".join(f'"{c}"' for c in CELLS) + "; do",
              "            for i in \"$folder\"/*.toml; do [[ -e $i ]] && names+=\" $(basename \"$i\" .toml)\"; done",
              "        done",
              '        COMPREPLY=($(compgen -W "$names" -- "$current") $(compgen -f -- "$current"))', "        return",
              "    fi", '    case "$command" in']
    for command in ["", *(row["command"] for row in table)]:
        row = next((r for r in table if r["command"] == command), None)
        words = list(below.get(command, []))
        words += [name for option in row["options"] for name in option["names"]] if row else ["--help", "--version"]
        lines.append(f'        "{command}") words="{" ".join(words)}" ;;')
    lines += ["    esac", '    if [[ $current == -* || -z $command ]]; then',
              '        COMPREPLY=($(compgen -W "$words" -- "$current"))', "    else",
              '        COMPREPLY=($(compgen -W "${words//-[^ ]*/}" -- "$current") $(compgen -f -- "$current"))', "    fi",
              "}", "complete -o filenames -F _qchopper qchopper"]
    return "\n".join(lines) + "\n"


def zsh_quoted(text):
    return re.sub(r"([\[\]:\\])", r"\\\1", text).replace("'", "'\\''")


def zsh_completion(table):
    below = {}
    for row in table:
        parent, _, last = row["command"].rpartition(" ")
        below.setdefault(parent, []).append((last, row["about"]))
    lines = ["#compdef qchopper", "# zsh completion of qchopper, made of its table of commands", ""]

    def function(command):
        return "_" + "_".join(["qchopper", *command.replace("-", "_").split()])

    for command in ["", *(row["command"] for row in table)]:
        row = next((r for r in table if r["command"] == command), None)
        lines.append(f"{function(command)}() {{")
        if command in below:
            lines += ["    local line state", "    local -a commands=("]
            lines += [f"        '{name}:{zsh_quoted(about)}'" for name, about in below[command]]
            lines += ["    )", "    _arguments -C '1: :->command' '*::argument:->rest'", "    case $state in",
                      "        command) _describe command commands ;;", "        rest)", "            case $line[1] in"]
            for name, _ in below[command]:
                lines.append(f"                {name}) {function((command + ' ' + name).strip())} ;;")
            lines += ["            esac ;;", "    esac"]
        else:
            lines.append("    _arguments \\")
            for option in row["options"]:
                for name in option["names"]:
                    value = ":value:_files" if option["takes_value"] else ""
                    lines.append(f"        '{name}[{zsh_quoted(option['about'])}]{value}' \\")
            lines.append("        '*:file:_files'")
        lines += ["}", ""]
    lines.append('_qchopper "$@"')
    return "\n".join(lines) + "\n"


def fish_quoted(text):
    return text.replace("\\", "\\\\").replace("'", "\\'")


def fish_completion(table):
    below = {}
    for row in table:
        parent, _, last = row["command"].rpartition(" ")
        below.setdefault(parent, []).append(last)
    lines = ["# fish completion of qchopper, made of its table of commands"]
    for row in table:
        parent, _, last = row["command"].rpartition(" ")
        names = " ".join(below[parent])
        if parent:
            when = f"__fish_seen_subcommand_from {parent}; and not __fish_seen_subcommand_from {names}"
        else:
            when = "__fish_use_subcommand"
        lines.append(f"complete -c qchopper -n '{when}' -f -a '{last}' -d '{fish_quoted(row['about'])}'")
        seen = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in row["command"].split())
        for option in row["options"]:
            shape = " ".join(("-l " + n[2:]) if n.startswith("--") else ("-s " + n[1:]) for n in option["names"])
            value = " -r" if option["takes_value"] else ""
            lines.append(f"complete -c qchopper -n '{seen}' {shape}{value} -d '{fish_quoted(option['about'])}'")
    return "\n".join(lines) + "\n"


def changelog(version, date):
    day = email.utils.format_datetime(datetime.fromtimestamp(date, timezone.utc))
    return (f"qchopper ({version}) unstable; urgency=medium\n\n"
            "  * What changed for operators is in CHANGELOG.md, in this folder.\n\n"
            f" -- The QChopper contributors <maintainers@qchopper.invalid>  {day}\n")


def main():
    program, version, folder = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    date = date_of_sources()
    table = command_table(program)
    about = "from the scan of a bone to carving jobs for a robot cell"
    write_packed(folder / "man1" / "qchopper.1.gz", manual_page(program, [], about, version, date))
    for row in table:
        words = row["command"].split()
        page = manual_page(program, words, row["about"], version, date)
        write_packed(folder / "man1" / ("-".join(["qchopper", *words]) + ".1.gz"), page)
    (folder / "qchopper.bash").write_text(bash_completion(table), encoding="utf-8")
    (folder / "_qchopper").write_text(zsh_completion(table), encoding="utf-8")
    (folder / "qchopper.fish").write_text(fish_completion(table), encoding="utf-8")
    write_packed(folder / "doc" / "changelog.gz", changelog(version, date))
    write_packed(folder / "doc" / "CHANGELOG.md.gz", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
