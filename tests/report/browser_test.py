#!/usr/bin/env python3
"""Opens pages of --report in Chromium, without a screen, and looks at what it makes of them.

    python3 tests/report/browser_test.py FOLDER_OF_PROGRAMS [FOLDER_FOR_PICTURES]

Ends with 77, which ctest calls skipped, where no Chromium is (Debian: chromium). With a folder it leaves pictures there,
to look at: wide, as wide as a telephone, dark, and without WebGL. Python's own library is all it needs.
"""
import html.parser
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import zlib

OPTIONS = ["--headless", "--disable-dev-shm-usage", "--hide-scrollbars", "--use-angle=swiftshader",
           "--enable-unsafe-swiftshader", "--virtual-time-budget=20000", "--enable-logging=stderr", "--no-first-run"]
HOSTILE = "<script>alert(1)<script>\"'&amp; x.obj"


def check(truth, what):
    if not truth:
        sys.exit("FAILED: " + what)


class Page(html.parser.HTMLParser):
    """What the tests ask of a document tree that the browser has written out."""

    def __init__(self, text):
        super().__init__()
        self.numbers, self.scripts, self.texts, self.root, self.tags = [], 0, {}, {}, []
        self.open = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self.scripts += tag == "script"
        if tag == "html":
            self.root = attributes
        if tag == "data":
            self.numbers.append((attributes["data-path"], attributes["value"]))
        if "id" in attributes:
            self.texts[attributes["id"]] = ""
        if tag not in ("meta", "input", "link", "br"):
            self.open.append((tag, attributes.get("id")))

    def handle_endtag(self, tag):
        while self.open and self.open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        for _, name in self.open:
            if name:
                self.texts[name] += data


def pixels_of(png):
    """Rows of (r, g, b) of an 8-bit PNG without interlacing."""
    at, packed = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", png[at + 8:at + 21])
            check(depth == 8 and colour in (2, 6) and not interlaced, "the screenshot is another kind of PNG")
        if kind == b"IDAT":
            packed += png[at + 8:at + 8 + length]
        at += 12 + length
    n, raw, previous, rows = (3 if colour == 2 else 4), zlib.decompress(packed), None, []
    for y in range(height):
        begin = y * (n * width + 1)
        how, line = raw[begin], bytearray(raw[begin + 1:begin + 1 + n * width])
        above = previous or bytearray(n * width)
        for k in range(len(line) if how else 0):
            left, up = (line[k - n] if k >= n else 0), above[k]
            corner = above[k - n] if k >= n else 0
            if how == 4:
                guess = left + up - corner
                nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                nearest = (0, left, up, (left + up) // 2)[how]
            line[k] = (line[k] + nearest) & 255
        previous = line
        rows.append([tuple(line[n * x:n * x + 3]) for x in range(width)])
    return rows


def counts_of(rows):
    """How many pixels are as blue as A, and as orange as B; and how many tones of them there are."""
    blue = [p for row in rows for p in row if p[2] > 120 and p[2] > 2.2 * p[0] and p[2] > 1.15 * p[1]]
    orange = [p for row in rows for p in row if p[0] > 130 and p[0] > 1.6 * p[1] and p[0] > 4 * p[2]]
    return len(blue), len(orange), len(set(blue + orange))


class Browser:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def open(self, page, picture, width=520, height=900, more=()):
        """The page with its picture. The browser counts a time of its own, and may take the picture while a script still
        waits for what another thread unpacks: such a page has not said how its viewer fares, and is opened again."""
        for _ in range(4):
            shown = self.opened(page, picture, width, height, more)
            if "viewer-code" not in shown.texts or "data-viewer" in shown.root:
                break
        return shown

    def opened(self, page, picture, width, height, more):
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
        shown, complaints = self.last_words_of(
            [self.program, *OPTIONS, *sandbox, *more, f"--window-size={width},{height}", f"--screenshot={picture}",
             "--dump-dom", pathlib.Path(page).as_uri()])
        of_page = [line for line in complaints.splitlines() if "CONSOLE" in line]
        check(not of_page, "the browser complains: " + "\n".join(of_page))
        check("</html>" in shown, "the browser gave no document: " + complaints[-2000:])
        check(os.path.exists(picture), "the browser made no picture: " + complaints[-2000:])
        return Page(shown)

    def last_words_of(self, command):
        """A browser without a screen, started on a machine with more work than processors, stands still for good one time
        in ten, with an empty page as well: it is then started again, with a profile of its own, four times in all."""
        for attempt in range(4):
            profile = tempfile.mkdtemp(dir=self.folder)
            process = subprocess.Popen([*command, f"--user-data-dir={profile}"], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True, start_new_session=True)
            try:
                return process.communicate(timeout=100)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                print(f"the browser stood still, attempt {attempt + 1} of 4", flush=True)
        sys.exit("FAILED: the browser stood still four times")


def check_numbers(shown, result, fewest):
    """What stands in the page is what the document has, and all of the document is there."""
    check(len(shown.numbers) >= fewest, "the page shows too few numbers")
    for path, value in shown.numbers:
        of_document = result
        for key in path.split("/")[1:]:
            of_document = of_document[int(key) if isinstance(of_document, list) else key]
        check(float(value) == of_document, f"{path} is {value} in the page and {of_document} in the document")
    check(json.loads(shown.texts["all-numbers"]) == result, "the page's document is another one")


def check_other_pages(programs, browser, out, has_viewer, wants_pictures):
    """Pages of the programs that run many pairs."""
    few = ["--threads", "2", "--quiet"]
    commands = {"scan": ["vex_scan", "cylinder:{L},0.5", "--for", "L=1:4:1", "--trials", "2048", *few],
                "virial": ["vex_virial", "capsule:2,0.5", "--order", "5", "--samples", "4e5", *few],
                "percolate": ["vex_percolate", "box:1,1,2", "--sizes", "2,3", "--realisations", "60", *few]}
    for name, (program, *words) in commands.items():
        page, document = str(out / f"{name}.html"), out / f"{name}.json"
        subprocess.run([programs / program, *words, "--report", page, "--json", str(document)], check=True)
        shown = browser.open(page, str(out / f"{name}.png"), 800, 2400)
        check_numbers(shown, json.loads(document.read_text()), 6)
        check("svg" in shown.tags and "table" in shown.tags, f"{name}: no plot or no table")
        blue, orange, tones = counts_of(pixels_of((out / f"{name}.png").read_bytes()))
        check(blue > 300 and orange > 1000 and tones > 20, f"{name}: the bodies are not drawn: {blue}, {orange}, {tones}")
        if has_viewer:
            check(shown.root.get("data-viewer") == "drawn", f"{name}: the viewer says: {shown.root.get('data-viewer')}")
        if wants_pictures:
            browser.open(page, str(out / f"{name}-dark.png"), 1200, 2400, ["--blink-settings=preferredColorScheme=0"])
            browser.open(page, str(out / f"{name}-telephone.png"), 390, 4000)


def main():
    programs = pathlib.Path(sys.argv[1]).resolve()
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        print("skipped: no Chromium is installed (Debian: chromium)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else folder).resolve()
        browser = Browser(chromium, folder)
        mesh = pathlib.Path(folder) / HOSTILE
        mesh.write_text("v 0 0 0\nv 1.5 0 0\nv 0 1 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        page, document = str(out / "report.html"), str(out / "report.json")
        subprocess.run([programs / "vex_mesh", "capsule:2,0.5", mesh, "--report", page, "--json", document, "--quiet",
                        "--trials", "8192"], check=True)
        shown = browser.open(page, str(out / "report.png"))
        result = json.loads(pathlib.Path(document).read_text())
        has_viewer = "viewer-code" in shown.texts

        check_numbers(shown, result, 6)
        check(shown.scripts == (5 if has_viewer else 3), f"{shown.scripts} scripts: a name has made one")
        check(HOSTILE in shown.texts["pair-alt"], "the file's name does not stand in the page as it is")
        check(result["bodies"][1]["source"].endswith(HOSTILE), "the document has another name")

        blue, orange, tones = counts_of(pixels_of((out / "report.png").read_bytes()))
        check(blue > 300 and orange > 1000 and tones > 20, f"the bodies are not drawn: {blue}, {orange}, {tones}")
        if has_viewer:
            check(shown.root.get("data-viewer") == "drawn", "the viewer says: " + str(shown.root.get("data-viewer")))
            check("canvas" in shown.tags, "there is no canvas")
            check(re.match(r"Orientation \d+ of \d+: excluded volume [0-9.]+", shown.texts["here"]), shown.texts["here"])

            still = browser.open(page, str(out / "still.png"), more=["--disable-3d-apis"])
            check("no WebGL" in still.texts["still-remark"], "without WebGL it says: " + still.texts["still-remark"])
            check("canvas" not in still.tags, "there is a canvas without WebGL")
            blue, orange, tones = counts_of(pixels_of((out / "still.png").read_bytes()))
            check(blue > 300 and orange > 1000 and tones > 5, f"the still is not drawn: {blue}, {orange}, {tones}")
        check_other_pages(programs, browser, out, has_viewer, len(sys.argv) > 2)
        if len(sys.argv) > 2:
            browser.open(page, str(out / "wide.png"), 1200, 3000)
            browser.open(page, str(out / "dark.png"), 1200, 3000, ["--blink-settings=preferredColorScheme=0"])
            browser.open(page, str(out / "telephone.png"), 390, 5000)
    print("passed")


if __name__ == "__main__":
    main()
