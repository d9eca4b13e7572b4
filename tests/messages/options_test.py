"""Every option that a message names exists on the commands that can print the message.

    options_test.py PROGRAM

Which commands these are follows from the headers that the sources include (tools/lib/messages.py),
which reaches further than what a command runs: a room of the library serves several commands. Where
that is too far, ONLY says which commands print the message.
"""

import json
import os
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools", "lib"))
from messages import Message, Reach, all_messages, source_files

READERS = {"smooth", "fill", "holes", "info", "compare", "view"}
WRITERS = {"smooth", "fill", "make"}

# For the files whose path starts so, the commands that can print the messages with this option.
ONLY = {
    ("src/commands/defect_warnings.cpp", "--strict"): {"smooth", "fill", "info"},
    ("src/commands/engine.cpp", "--engine"): {"smooth"},
    ("src/commands/report/report_formats.cpp", "--report"): READERS,
    ("src/commands/shared_options.cpp", "--weld"): READERS,
    ("src/ibmfair/energy/", "--anisotropy"): {"smooth"},
    ("src/ibmfair/energy/", "--engine"): {"smooth"},
    ("src/ibmfair/energy/", "--h0"): {"smooth"},
    ("src/ibmfair/energy/", "--keep-sharp"): {"smooth", "fill"},
    ("src/ibmfair/energy/", "--no-mass"): {"smooth", "fill"},
    ("src/ibmfair/energy/", "--mass"): {"smooth", "fill", "info"},
    ("src/ibmfair/flow/flow_options.cpp", "--keep-area"): {"smooth"},
    ("src/ibmfair/flow/flow_options.cpp", "--keep-sharp"): {"smooth", "fill"},
    ("src/ibmfair/flow/flow_options.cpp", "--keep-volume"): {"smooth"},
    ("src/ibmfair/flow/flow_options.cpp", "--max-move"): {"smooth"},
    ("src/ibmfair/flow/flow_options.cpp", "--solver-tolerance"): {"smooth"},
    ("src/ibmfair/flow/linear_system/choose_backend.cpp", "--memory"): {"smooth", "fill"},
    # fill has the solver `auto`, which is refused only if no other solver fits.
    ("src/ibmfair/flow/linear_system/choose_backend.cpp", "--solver"): {"smooth"},
    ("src/ibmfair/flow/steps/conserved_quantities.cpp", "--keep-area"): {"smooth"},
    ("src/ibmfair/flow/steps/conserved_quantities.cpp", "--keep-volume"): {"smooth"},
    ("src/ibmfair/io/face_edits.cpp", "--stitch"): {"fill"},
    ("src/ibmfair/io/mesh_file.cpp", "--input-format"): READERS,
    ("src/ibmfair/io/mesh_file.cpp", "--weld"): READERS,
    ("src/ibmfair/io/ply_patch.cpp", "--precision"): WRITERS,
    ("src/ibmfair/io/write_mesh.cpp", "--format"): WRITERS,
    ("src/ibmfair/io/write_mesh.cpp", "--precision"): WRITERS,
    ("src/ibmfair/solve/cholmod_library.cpp", "--solver"): {"smooth"},
}


def usage():
    run = subprocess.run([PROGRAM, "--json-usage"], capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


class Options(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.messages = all_messages()
        program = usage()
        cls.options = {command["name"]: {option["name"] for option in command["options"]}
                       for command in program["commands"]}
        cls.of_program = {option["name"] for option in program["options"]}
        reach = Reach()
        cls.files = {}
        for command, options in cls.options.items():
            roots = [f"src/commands/{command}.cpp"]
            if "--out-dir" in options:
                roots.append("src/commands/many_files.cpp")
            if "--engine" in options:
                roots += [path for path in source_files() if path.startswith("src/petsc_engine/")]
            cls.files[command] = reach.files(roots)

    def printers(self, message, option):
        """The commands that can print this message."""
        for (path, name), commands in ONLY.items():
            if message.path.startswith(path) and name == option:
                return commands
        reaching = {command for command, files in self.files.items() if message.path in files}
        return reaching or set(self.options)

    def faults(self, messages):
        found = []
        for message in messages:
            for option, command in message.options():
                for printer in sorted({command} if command else self.printers(message, option)):
                    known = self.of_program if printer == "ibmfair" else self.options.get(printer, ())
                    if option not in known:
                        found.append(f"{message.path}:{message.line}: {printer} has no {option}: "
                                     f"{message.text}")
        return found

    def test_options_in_messages_exist(self):
        self.assertGreater(len(self.messages), 400)
        self.assertGreater(sum(len(message.options()) for message in self.messages), 60)
        self.assertEqual(self.faults(self.messages), [])

    def test_a_wrong_option_is_found(self):
        for path, text in (
                ("src/ibmfair/io/mesh_file.cpp", "cannot tell the mesh format; name it with --format"),
                ("src/commands/holes.cpp", "--cutoff helps"),
                ("src/commands/smooth_remarks.cpp", "--nonsense helps"),
                ("src/commands/command_line.cpp", "--cutoff helps"),
                ("src/commands/info.cpp", "`fill --cutoff` fills it")):
            with self.subTest(path=path, text=text):
                self.assertTrue(self.faults([Message(path, 1, "refusal", text)]))

    def test_exceptions_are_needed(self):
        for (path, option), commands in ONLY.items():
            with self.subTest(path=path, option=option):
                self.assertTrue(commands <= set(self.options))
                concerned = [message for message in self.messages if message.path.startswith(path)
                             and (option, None) in message.options()]
                self.assertTrue(concerned, "no message names the option")
                self.assertTrue(any(
                    option not in self.options[command] and message.path in files
                    for message in concerned for command, files in self.files.items()))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
