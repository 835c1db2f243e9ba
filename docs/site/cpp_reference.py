"""The C++ reference: Doxygen reads the public headers, and its XML becomes one page for each folder.

The headers have comments as `///`, and their introduction and many members as plain `//`. A filter shows Doxygen both.

    cpp_reference.py FILE      prints a header as Doxygen gets it
"""
from __future__ import annotations

import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SOURCE = ROOT / "src" / "scabo"
# Folders in the sequence of the data, with the headers that a program uses; the rest of a folder serves these.
FOLDERS = {
    "input": ("Model files", ["read_model.hpp"]),
    "model": ("The model", ["model.hpp", "*.hpp"]),
    "mesh": ("Meshes", ["mesh.hpp", "plane/domain.hpp"]),
    "element": ("Super-elements", ["sbfem/super_element.hpp", "sbfem/modal_solution.hpp", "facet/coefficient_matrices.hpp", "facet/mass.hpp",
                                   "plane/elasticity.hpp", "plane/stiffness.hpp", "plane/interior_field.hpp", "plane/stress_intensity.hpp",
                                   "plane/singular_field.hpp", "cell_library.hpp"]),
    "contact": ("The contact problem", ["problem.hpp", "solution.hpp", "solve.hpp", "certificate.hpp", "judge.hpp", "delassus.hpp",
                                        "rigid_map.hpp", "questions/uniqueness.hpp", "questions/infeasibility.hpp"]),
    "analysis": ("Analyses", ["static_analysis.hpp", "state/solution.hpp", "state/results.hpp", "march/options.hpp", "modal/modal_analysis.hpp",
                              "adaptive/adaptive.hpp", "adaptive/goal.hpp"]),
    "result": ("Results", ["*.hpp"]),
    "run": ("Whole runs", ["*.hpp"]),
    "base": ("Types and errors", ["types.hpp", "error.hpp", "warning.hpp"]),
}


def filtered(text: str) -> str:
    """The header with comments as Doxygen reads them; lines keep their numbers."""
    lines = text.split("\n")
    head = 0
    while head < len(lines) and lines[head].startswith("//"):
        head += 1
    out = []
    for number, line in enumerate(lines):
        if number < head:
            out.append(line)  # shown by introduction_of, as it is laid out
            continue
        if re.match(r"^\s*// [^-]", line) and not line.lstrip().startswith("///"):
            line = re.sub(r"//", "///", line, count=1)
        else:
            line = re.sub(r"(\S\s+)//(?![/<])", r"\1///<", line, count=1)
        out.append(line)
    return "\n".join(out)


def headers() -> dict[str, list[pathlib.Path]]:
    chosen: dict[str, list[pathlib.Path]] = {}
    for folder, (_, patterns) in FOLDERS.items():
        for pattern in patterns:
            for file in sorted((SOURCE / folder).glob(pattern)):
                if file not in chosen.setdefault(folder, []):
                    chosen[folder].append(file)
    return chosen


def write(pages: pathlib.Path, output: pathlib.Path) -> None:
    output.mkdir(parents=True, exist_ok=True)
    chosen = headers()
    inputs = " ".join(str(file) for files in chosen.values() for file in files)
    settings = f"""
PROJECT_NAME = Scabo
INPUT = {inputs}
OUTPUT_DIRECTORY = {output}
GENERATE_XML = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
XML_PROGRAMLISTING = NO
QUIET = YES
WARNINGS = NO
MARKDOWN_SUPPORT = NO
AUTOLINK_SUPPORT = NO
EXTRACT_ALL = YES
EXTRACT_PRIVATE = NO
JAVADOC_AUTOBRIEF = NO
STRIP_FROM_PATH = {ROOT / 'src'}
FULL_PATH_NAMES = YES
MACRO_EXPANSION = NO
INPUT_FILTER = "/usr/bin/python3 {pathlib.Path(__file__).resolve()}"
"""
    done = subprocess.run(["doxygen", "-"], input=settings, text=True, capture_output=True)
    if done.returncode:
        raise SystemExit(f"C++ reference: doxygen failed:\n{done.stderr}")
    xml = Headers(output / "xml")
    index = ["# C++: headers", "", "The headers that a program uses, made from the sources. `#include <scabo/FOLDER/HEADER.hpp>` and",
             "`target_link_libraries(... scabo::scabo)` ([how](../README.md#the-library)); every other header is installed too, and",
             "[the architecture](../ARCHITECTURE.md) says what is where.", "", "| folder | what it has | headers |", "|---|---|---|"]
    (pages / "cpp").mkdir(parents=True, exist_ok=True)
    for folder, files in chosen.items():
        title = FOLDERS[folder][0]
        index.append(f"| [{folder}](cpp/{folder}.md) | {title} | {', '.join(f'`{file.name}`' for file in files)} |")
        lines = [f"# {title}: scabo/{folder}", ""]
        for file in files:
            lines += [f"## {file.name}", "", f"`#include <scabo/{file.relative_to(SOURCE).as_posix()}>`", "", *introduction_of(file), "", *xml.contents_of(file), ""]
        (pages / "cpp" / f"{folder}.md").write_text("\n".join(lines), encoding="utf-8")
    index += ["", "```{toctree}", ":hidden:", "", *(f"cpp/{folder}" for folder in chosen), "```", ""]
    (pages / "cpp.md").write_text("\n".join(index), encoding="utf-8")


class Headers:
    """What Doxygen's XML says of each header."""

    def __init__(self, xml: pathlib.Path) -> None:
        self.xml = xml
        self.files = {}
        for compound in ElementTree.parse(xml / "index.xml").getroot().findall("compound[@kind='file']"):
            root = ElementTree.parse(xml / f"{compound.get('refid')}.xml").getroot().find("compounddef")
            self.files[pathlib.Path(root.find("location").get("file")).as_posix()] = root

    def contents_of(self, file: pathlib.Path) -> list[str]:
        root = next(root for name, root in self.files.items() if file.as_posix().endswith(name))
        lines = []
        for inner in root.findall("innerclass"):
            if inner.get("prot") == "public" and "@" not in inner.text:
                lines += self.type_of(inner.get("refid"))
        for kind in ("enum", "typedef", "var", "func"):
            for section in root.findall(f"sectiondef[@kind='{kind}']"):
                for member in section.findall("memberdef"):
                    lines += ["```cpp", declaration_of(member), "```", "", description_of(member), ""]
        return lines

    def type_of(self, reference: str) -> list[str]:
        """A struct or class: its public functions as declarations, its values as a table."""
        root = ElementTree.parse(self.xml / f"{reference}.xml").getroot().find("compounddef")
        name = root.find("compoundname").text
        lines = [f"### {root.get('kind')} {name.removeprefix('scabo::')}", "", description_of(root), ""]
        values = [member for kind in ("public-attrib", "public-static-attrib") for section in root.findall(f"sectiondef[@kind='{kind}']")
                  for member in section.findall("memberdef")]
        if values:
            lines += ["| member | type | default | meaning |", "|---|---|---|---|"]
            for member in values:
                default = text_of(member.find("initializer")).lstrip("= ")
                lines.append(f"| `{member.find('name').text}` | `{cell(text_of(member.find('type')))}` | {f'`{cell(default)}`' if default else ''} |"
                             f" {cell(description_of(member))} |")
            lines.append("")
        for kind in ("public-type", "public-func", "public-static-func"):
            for section in root.findall(f"sectiondef[@kind='{kind}']"):
                for member in section.findall("memberdef"):
                    lines += ["```cpp", declaration_of(member), "```", "", description_of(member), ""]
        return lines


def text_of(element: ElementTree.Element | None) -> str:
    text = " ".join("".join(element.itertext()).split()) if element is not None else ""
    return text.replace("< ", "<").replace(" >", ">") if "::" in text and "< " in text else text


def declaration_of(member: ElementTree.Element) -> str:
    name, kind = member.find("name").text, member.get("kind")
    template = text_of(member.find("templateparamlist"))
    if kind == "enum":
        values = ", ".join(value.find("name").text for value in member.findall("enumvalue"))
        return f"enum class {name} {{ {values} }};"
    if kind == "typedef":
        return f"using {name} = {text_of(member.find('type'))};"
    head = text_of(member.find("type"))
    head = f"static {head}" if member.get("static") == "yes" and kind == "function" else head
    parameters = [f"template <{', '.join(text_of(each) for each in member.find('templateparamlist'))}>\n" if template else ""]
    text = f"{head} {name}".strip()
    if kind == "function":
        arguments = [f"{text_of(each.find('type'))} {text_of(each.find('declname'))}{text_of(each.find('array'))}".strip()
                     + (f" = {text_of(each.find('defval'))}" if each.find("defval") is not None else "") for each in member.findall("param")]
        one = f"{text}({', '.join(arguments)})"
        text = one if len(one) <= 110 else f"{text}(\n    " + ",\n    ".join(arguments) + ")"
        text += " const" if member.get("const") == "yes" else ""
    else:
        text += " " + text_of(member.find("initializer")) if member.find("initializer") is not None else ""
    return f"{parameters[0]}{text};"


def description_of(element: ElementTree.Element) -> str:
    paragraphs = [text_of(paragraph) for part in ("briefdescription", "detaileddescription") if element.find(part) is not None
                  for paragraph in element.find(part).findall("para")]
    return "\n\n".join(escaped(paragraph) for paragraph in paragraphs if paragraph)


def escaped(text: str) -> str:
    """Plain text with `code` as Markdown."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([*_$<>\[\]\\])", r"\\\1", part) for part in parts)


def cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n\n", " ")


def introduction_of(file: pathlib.Path) -> list[str]:
    """The comment at the head of a header, as it is laid out there."""
    lines = []
    for line in file.read_text(encoding="utf-8").split("\n"):
        if not line.startswith("//"):
            break
        lines.append(line[3:])
    return ["```text", *lines, "```"] if lines else []


if __name__ == "__main__":
    sys.stdout.write(filtered(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")))
