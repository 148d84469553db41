"""What the program's reader tells of its keys (`freshet check SCENE --keys`), for tools/scene-keys."""
import pathlib
import re
import subprocess

SELECTORS = {  # which keys there are depends on these
    "scene": "method", "sph": "stabilise", "sisph": "formulation", "gauge": "what",
    "boundary": "type", "bed.shape": "type", "compare.exact": "type"}
TYPED = {"boundary", "bed.shape", "compare.exact"}  # a key may mean another thing under another type
SERIES = re.compile(r"boundary\.\w+|(gauge|profile)\.measured")  # where a table stands there
CALL = re.compile(r'\b(?:number|integer|boolean|text|choices?|numbers|points?|function|velocity|file|table'
                  r'|size_of|element|accept|pair|factor|word|in_time|if_given)(?:<[^()]*>)?\(\s*"(\w+)"'
                  r'|\b\w+\((?:section|table|shape|region|bed|root|domain|duration),\s*"(\w+)"'
                  r'|\bone_(?:of|in_time)\(\{([^}]*)\}')


def keys_of_sources(root):
    """Name of every key that is read: where, as file:line."""
    found = {}
    for file in [*sorted((root / "src/scene").rglob("*.cpp")), *sorted((root / "kernels").rglob("*.hpp"))]:
        text = file.read_text()
        for call in CALL.finditer(text):
            line = 1 + text.count("\n", 0, call.start())
            for name in re.findall(r'"(\w+)"', call[3]) if call[3] else [call[1] or call[2]]:
                found.setdefault(name, f"{file.relative_to(root)}:{line}")
    return found


def ask_program(program, folder):
    """A function of a scene's name, text and overrides that gives the rows of its keys.

    It raises RuntimeError with the program's words."""
    def ask(name, text, *overrides):
        scene = pathlib.Path(folder, name + ".toml")
        scene.write_text(text)
        run = subprocess.run([program, "check", scene, *overrides, "--keys"], capture_output=True, text=True)
        if run.returncode != 0:
            raise RuntimeError(run.stderr.strip())
        return [line.split("\t") for line in run.stdout.splitlines()[1:]]
    return ask


def tidy(text):
    """Numbers as people write them: 1e-5, 0.7906."""
    def number(match):
        value = f"{float(match[0]):.4g}" if len(match[0]) > 7 else match[0]
        return re.sub(r"e([+-])0*", lambda e: "e" + e[1].strip("+"), value)
    return re.sub(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]\d+)?(?![\w.])", number, text)


def value_of(what, rule):
    rule = re.sub(r" \([^()]*\d[^()]*\)", "", rule)  # a number of one scene
    words = re.sub(r"'([^']+)'", r'`"\1"`', what)
    return tidy(words + (", " if what and rule else "") + re.sub(r"'(\w+)'", r"`\1`", rule))


def split_by(seen, place):
    groups = {}
    for row in seen:
        if row[2] not in groups.setdefault(row[place], []):
            groups[row[place]].append(row[2])
    return groups


def merged_value(seen):
    """One text for those of all scenes, rows of (dimension, method, text); None: it depends on the scene."""
    texts = {row[2] for row in seen}
    if len({re.sub(r"\d[\d.]*", "0", t) for t in texts}) < len(texts):
        return None
    groups = split_by(seen, 0)
    plane, line = groups.get(2, []), groups.get(1, [])
    if set(line) <= set(plane) or set(plane) <= set(line):
        return " or ".join(max(plane, line, key=len))
    return " or ".join(plane) + "; 1-D: " + " or ".join(line)


def merged_default(seen):
    for place, usual in ((0, 2), (1, "sph-swe")):
        groups = split_by(seen, place)
        if all(len(texts) == 1 for texts in groups.values()):
            main = groups.get(usual, *list(groups.values())[:1])[0] if groups else ""
            others = [("1-D: " if name == 1 else f"`{name}`: ") + texts[0]
                      for name, texts in groups.items() if texts[0] != main]
            return "; ".join([main, *others])
    return None


def at(tree, parts):
    """What stands there in a scene, elements of lists by name or number; None: nothing."""
    for part in parts:
        if isinstance(tree, list):
            tree = next((e for i, e in enumerate(tree) if part in (e.get("name"), str(i))), None)
        else:
            tree = tree.get(part) if isinstance(tree, dict) else None
    return tree


def names_of(path, tree):
    """The key without its elements' names; with the type of its table; both of the key whose series it is."""
    parts, name, typed, series = path.split("."), [], [], None
    for k, part in enumerate(parts):
        if not isinstance(at(tree, parts[:k]), list):
            name.append(part)
            typed.append(part)
        here, table = at(tree, parts[:k + 1]), ".".join(name)
        if isinstance(here, dict) and table in TYPED:
            typed.append(here.get(SELECTORS[table], ""))
        if isinstance(here, dict) and SERIES.fullmatch(table):
            series, name, typed = (table, ".".join(typed)), ["series"], ["series"]
    return ".".join(name), ".".join(typed), series
