"""The Debian package, unpacked where nothing else of the program is, and the libraries as another project finds them.

    package_test.py BUILD PROGRAM CMAKE
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD, PROGRAM, CMAKE = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
CELLS = {"foam-1", "gantry-3axis", "irb6640-185-2.8", "kr120-r2500-pro-rotary", "kr60-ha"}
LARGEST = 8 * 1024 * 1024


def run(*arguments, **options):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False, **options)
    if result.returncode != 0:
        raise AssertionError(f"{arguments} ended with {result.returncode}:\n{result.stdout}\n{result.stderr}")
    return result.stdout


def made_in(folder):
    """The package, made there."""
    environment = dict(os.environ, SOURCE_DATE_EPOCH="1700000000")
    documents = BUILD / "packaging" / "documents"
    version = re.search(r"^project\(qchopper VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
    run(sys.executable, "-B", ROOT / "packaging" / "documents.py", PROGRAM, version, documents, env=environment)
    run(CMAKE.with_name("cpack"), "--config", BUILD / "CPackConfig.cmake", "-B", folder, env=environment,
        preexec_fn=lambda: os.umask(0o022))
    return next(folder.glob("*.deb"))


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="qchopper-package-"))
        cls.package = made_in(cls.folder / "one")
        cls.root = cls.folder / "root"
        run("dpkg-deb", "-x", cls.package, cls.root)
        cls.program = cls.root / "usr" / "bin" / "qchopper"
        cls.elsewhere = cls.folder / "elsewhere"
        cls.elsewhere.mkdir()
        cls.table = json.loads(run(cls.program, "schema", "commands"))["commands"]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_is_small_and_the_same_to_the_byte_when_made_again(self):
        self.assertLess(self.package.stat().st_size, LARGEST)
        self.assertEqual(self.package.read_bytes(), made_in(self.folder / "two").read_bytes())

    def test_lintian_finds_nothing(self):
        said = run("lintian", "--allow-root", "--fail-on", "error,warning", self.package)
        self.assertEqual([line for line in said.splitlines() if re.match("[EW]:", line)], [])

    def test_its_cells_are_found_by_name(self):
        listed = json.loads(run(self.program, "cells", "list", "--json", cwd=self.elsewhere))
        files = {Path(row["file"]) for row in listed["cells"]}
        self.assertEqual({file.stem for file in files}, CELLS)
        self.assertTrue(all(self.root in file.parents for file in files), files)
        for name in CELLS:
            shown = json.loads(run(self.program, "cells", "show", name, "--json", cwd=self.elsewhere))
            self.assertIn(f"{name}.toml", json.dumps(shown))
        own = self.elsewhere / "cells" / "kr60-ha.toml"
        own.parent.mkdir()
        own.write_text((ROOT / "cells" / "kr60-ha.toml").read_text().replace("KUKA KR 60 HA", "Cell of the workshop"))
        shown = json.loads(run(self.program, "cells", "show", "kr60-ha", "--json", cwd=self.elsewhere))
        self.assertIn("Cell of the workshop", json.dumps(shown))
        shutil.rmtree(own.parent)

    def test_goes_from_a_specimen_to_jobs(self):
        run(self.program, "sample", "vertebra", "--faces", "3000", "-o", "v.ply", cwd=self.elsewhere)
        run(self.program, "prepare", "v.ply", "--units", "mm", "--scale", "0.4", "--cell", "foam-1", "-o", "v.qch",
            cwd=self.elsewhere)
        self.assertTrue(list((self.elsewhere / "v.qch" / "jobs").glob("*.qjob")))

    def test_every_command_and_option_is_in_manual_page_and_completions(self):
        usr = self.root / "usr" / "share"
        completions = {
            "bash": (usr / "bash-completion" / "completions" / "qchopper").read_text(),
            "zsh": (usr / "zsh" / "vendor-completions" / "_qchopper").read_text(),
            "fish": (usr / "fish" / "vendor_completions.d" / "qchopper.fish").read_text(),
        }
        self.assertGreater(len(self.table), 20)
        for row in self.table:
            name = "-".join(["qchopper", *row["command"].split()])
            page = run("zcat", usr / "man" / "man1" / f"{name}.1.gz").replace("\\", "")
            for option in row["options"]:
                for flag in option["names"]:
                    self.assertIn(flag, page, name)
                    for shell in ("bash", "zsh"):
                        self.assertIn(flag, completions[shell], f"{shell} {name}")
                    shape = f"-l {flag[2:]}" if flag.startswith("--") else f"-s {flag[1:]}"
                    self.assertIn(shape, completions["fish"], name)

    def test_bash_completes(self):
        script = self.root / "usr" / "share" / "bash-completion" / "completions" / "qchopper"

        def completed(*words):
            asked = f'source "{script}"; COMP_WORDS=({" ".join(words)}); COMP_CWORD={len(words) - 1}; _qchopper; ' \
                    'printf "%s\\n" "${COMPREPLY[@]}"'
            return set(run("bash", "-c", asked, cwd=ROOT).split())

        self.assertEqual(completed("qchopper", "pre"), {"prepare"})
        self.assertEqual(completed("qchopper", "cells", "sh"), {"show"})
        self.assertEqual(completed("qchopper", "prepare", "--max-f"), {"--max-faces"})
        self.assertEqual(completed("qchopper", "verify", "--max-f"), set())
        self.assertEqual(completed("qchopper", "prepare", "--cell", "kr"), {"kr60-ha", "kr120-r2500-pro-rotary"})

    def test_the_service_is_confined(self):
        if shutil.which("systemd-analyze") is None:
            self.skipTest("skipped: systemd is not here")
        unit = self.root / "usr" / "lib" / "systemd" / "system" / "qchopper-cell-sim.service"
        said = run("systemd-analyze", "security", "--offline=true", unit)
        self.assertLess(float(re.search(r"exposure level.*: ([0-9.]+)", said)[1]), 3.0)

    def test_the_program_is_hardened(self):
        self.assertIn("BIND_NOW", run("readelf", "-d", self.program))
        self.assertIn("DYN", run("readelf", "-h", self.program))
        self.assertIn("__memcpy_chk", run("readelf", "--dyn-syms", "-W", self.program))


class Libraries(unittest.TestCase):
    def test_another_project_finds_and_links_them(self):
        with tempfile.TemporaryDirectory(prefix="qchopper-consumer-") as name:
            folder = Path(name)
            run(CMAKE, "--install", BUILD, "--component", "library", "--prefix", folder / "installed")
            run(CMAKE, "-S", ROOT / "tests" / "package" / "consumer", "-B", folder / "build",
                f"-DCMAKE_PREFIX_PATH={folder / 'installed'}", "-DCMAKE_BUILD_TYPE=Release")
            run(CMAKE, "--build", folder / "build")
            run(PROGRAM, "sample", "femur", "--faces", "2000", "-o", folder / "femur.ply")
            self.assertRegex(run(folder / "build" / "consumer", folder / "femur.ply"),
                             r"^[2-9] pieces, 1\.000000 of the volume$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
