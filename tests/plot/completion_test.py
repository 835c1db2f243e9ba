"""Completion in shells, and the manual page: both have exactly the commands and options of the help."""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support


def help_of(*command):
    return support.scabo(*command, "--help").stdout


def commands():
    return re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[1].split("Exit status")[0], re.MULTILINE)


def options_of(*command):
    """Flags at the beginning of lines of the help."""
    lines = re.findall(r"^  (-.*?)(?:  |$)", help_of(*command), re.MULTILINE)
    return sorted(flag for line in lines for flag in re.findall(r"(?<![\w-])--?[A-Za-z][a-z-]*", line))


def has(program):
    return shutil.which(program) is not None


class Completion(support.InTemporaryDirectory):
    def script(self, shell):
        run = support.scabo("completion", shell)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        path = self.directory / f"script.{shell}"
        path.write_text(run.stdout, encoding="utf-8")
        return path

    def bash(self, *words):
        """What bash offers for the last word."""
        text = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }; _scabo; printf "%s\\n" "${COMPREPLY[@]}"'
        run = subprocess.run(["bash", "-c", text, "bash", self.script("bash"), "scabo", *words], text=True, capture_output=True,
                             cwd=self.directory, timeout=support.PATIENCE)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return sorted(run.stdout.split())

    def test_help_is_read(self):
        self.assertIn("plot", commands())
        self.assertIn("--ignore-memory", options_of("run"))
        self.assertGreaterEqual(len(commands()), 10)

    def test_bash_offers_commands_and_options(self):
        self.assertEqual(self.bash(""), sorted(commands() + options_of()))
        for command in commands():
            self.assertEqual(self.bash(command, "-"), options_of(command), command)
        self.assertEqual(self.bash("pl"), ["plot"])
        self.assertEqual(self.bash("run", "--ou"), ["--output"])

    def test_bash_offers_files_and_choices(self):
        for name in ("a.yaml", "b.json", "c.txt", "with space.yaml"):
            (self.directory / name).touch()
        (self.directory / "a.results").mkdir()
        offered = self.bash("run", "")
        self.assertIn("a.yaml", offered)
        self.assertIn("b.json", offered)
        self.assertIn("a.results", offered, "models may be in it")
        self.assertNotIn("c.txt", offered)
        self.assertEqual(self.bash("plot", ""), ["a.results"])
        self.assertEqual(self.bash("run", "a.yaml", "-o", ""), ["a.results"])
        self.assertEqual(self.bash("new", ""), ["axisymmetric", "beam", "crack", "dam", "earthquake", "growth", "hertz", "part3d", "wall"])
        self.assertEqual(self.bash("plot", "--what", "co"), ["contact", "convergence"])
        self.assertEqual(self.bash("run", "--threads", ""), [])
        self.assertIn("c.txt", self.bash("contact", ""))

    def test_zsh_and_fish_name_every_option(self):
        for shell, option in (("zsh", lambda flag: rf"(?<![\w-]){re.escape(flag)}(?![\w-])"),
                              ("fish", lambda flag: rf" -l {flag[2:]} " if flag.startswith("--") else rf" -s {flag[1:]} ")):
            text = self.script(shell).read_text(encoding="utf-8")
            for command in commands():
                parts = {"zsh": text.split(f"        {command}) ")[-1].split(";;")[0],
                         "fish": "\n".join(line for line in text.splitlines() if f"from {command}'" in line)}
                for flag in options_of(command):
                    self.assertRegex(parts[shell], option(flag), f"{shell}, {command}")

    def test_shells_accept_their_scripts(self):
        for program, check in (("bash", ["bash", "-n"]), ("zsh", ["zsh", "-n"]), ("fish", ["fish", "--no-execute"])):
            if has(program):
                run = subprocess.run([*check, self.script(program)], text=True, capture_output=True, timeout=support.PATIENCE)
                self.assertEqual((run.returncode, run.stderr), (0, ""), program)

    @unittest.skipUnless(has("fish"), "fish is not installed")
    def test_fish_offers_them(self):
        def fish(line):
            run = subprocess.run(["fish", "--no-config", "-c", f"source {self.script('fish')}; complete -C '{line}'"], text=True,
                                 capture_output=True, cwd=self.directory, timeout=support.PATIENCE)
            return sorted(word.split("\t")[0] for word in run.stdout.splitlines())
        self.assertEqual(fish("scabo "), sorted(commands()))
        self.assertEqual(fish("scabo plot --what co"), ["contact", "convergence"])
        self.assertEqual(sorted(word for word in fish("scabo run --") if word.startswith("--")),
                         [flag for flag in options_of("run") if flag.startswith("--")])

    def test_unknown_shells_are_refused(self):
        run = support.scabo("completion", "tcsh")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("'tcsh' is none of bash, zsh, fish", run.stderr)


class Manual(support.InTemporaryDirectory):
    def test_it_has_every_command_and_option(self):
        text = support.scabo("manual").stdout.replace("\\-", "-").replace("\\fB", "").replace("\\fR", "").replace("\\fI", "")
        for command in commands():
            section = text.split(f".SS scabo {command}\n")[1].split("\n.S")[0]
            listed = sorted(flag for line in re.findall(r"^\.TP\n(-.*)$", section, re.MULTILINE)
                            for flag in re.findall(r"(?<![\w-])--?[A-Za-z][a-z-]*", line))
            self.assertEqual(listed, options_of(command), command)
        for status in ("0 ", "130"):
            self.assertIn(f"\n  {status}", text)

    def test_it_is_set_without_warnings(self):
        if not has("groff"):
            self.skipTest("groff is not installed")
        page = support.scabo("manual").stdout
        run = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-rF0"], input=page, text=True, capture_output=True, timeout=support.PATIENCE)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("SYNOPSIS", re.sub("(?s).\x08", "", run.stdout))


if __name__ == "__main__":
    support.main()
