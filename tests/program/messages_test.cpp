// What the program says when it refuses something: the file or option, the cause, and what helps.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

/// A command that is refused, and the parts of its message.
struct Refusal {
  Words words;
  Words parts;
  int exit_code = 2;
};

class Messages : public testing::Test {
 protected:
  Messages() {
    make("ball.off", {"icosphere", "--subdivide", "1"});
    make("open.off", {"cylinder", "--rows", "4"});
    make("tiny.off", {"icosphere", "--subdivide", "1", "--scale", "1e-90"});
    write("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n3 0 1 2\n3 1 2 3\n");
    write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\n");
    write("defects.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 3\n");
    write("text.dat", "hello world\n");
    write("three.txt", "1 2 3\n");
    write("words.txt", "1\n2 x\n");
    write("far.txt", "0 1 99999\n");
  }

  void make(const std::string& name, const Words& words) const {
    const RunResult result = run_program(Words{"make"} + Words{words.front(), directory_ / name} +
                                         Words(words.begin() + 1, words.end()));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  void write(const std::string& name, const std::string& bytes) const {
    write_bytes(directory_ / name, bytes);
  }

  RunResult run(const Words& words) const {
    return run_program(words, {.directory = directory_ / ""});
  }

  void expect(const std::vector<Refusal>& refusals) const {
    for (const Refusal& refusal : refusals) {
      std::string line;
      for (const std::string& word : refusal.words) {
        line += word + " ";
      }
      SCOPED_TRACE(line);
      const std::size_t entries = directory_.entries();
      const RunResult result = run(refusal.words);
      EXPECT_EQ(result.exit_code, refusal.exit_code);
      for (const std::string& part : refusal.parts) {
        EXPECT_TRUE(contains(result.err, part)) << part << "\n" << result.err;
      }
      EXPECT_EQ(directory_.entries(), entries);
    }
  }

  TemporaryDirectory directory_;
};

TEST_F(Messages, NameTheWordsThatAnOptionTakes) {
  expect({
      {{"smooth", "ball.off", "o.off", "--cutoff", "AUTO"}, {"--cutoff: 'AUTO'", "8e", "or auto"}},
      {{"fill", "open.off", "o.off", "--keep-sharp", "AUTO"}, {"--keep-sharp: 'AUTO'", "or auto"}},
      {{"fill", "open.off", "o.off", "--keep-sharp", "200"}, {"200", "at most 180", "or auto"}},
      {{"fill", "open.off", "o.off", "--rim-smooth", "AUTO"}, {"--rim-smooth: 'AUTO'", "or auto"}},
      {{"smooth", "ball.off", "o.off", "--keep-sharp", "200"}, {"--keep-sharp", "at most 180"}},
      {{"compare", "ball.off", "--sphere", "FIT"}, {"--sphere: 'FIT'", "or fit"}},
      {{"smooth", "ball.off", "o.off", "--mass", "lumped"}, {"--mass: 'lumped'", "voronoi"}},
      {{"make", "torus", "o.ply", "--precision", "single"}, {"'single'", "keep, float, double"}},
      {{"smooth", "ball.off", "o.off", "--steps", "many"}, {"--steps: 'many'", "whole number"}},
      {{"make", "torus", "o.off", "--move", "1,2"}, {"--move: '1,2'", "3 of them"}},
  });
}

TEST_F(Messages, NameTheMistakeBeforeTheEndOfTheOptions) {
  expect({{{"smooth", "--laplacian", "bi", "--", "ball.off", "out.off"}, {"'bi' is not known"}},
          {{"smooth", "--stesp", "2", "--", "ball.off", "out.off"}, {"'--stesp'", "'--steps'"}}});
}

TEST_F(Messages, TakeANumberBehindAnOptionalLengthForTheLength) {
  for (const std::string option : {"--weld", "--stitch"}) {
    for (const std::string length : {"0", "-1", "0e", "-2%"}) {
      expect({{{"fill", "open.off", "o.off", option, length},
               {fmt::format("{}: '{}' is not a positive length", option, length),
                fmt::format("nothing behind {}", option)}}});
    }
  }
  expect({{{"info", "--weld", "0", "ball.off"}, {"--weld: '0' is not a positive length"}}});
  EXPECT_EQ(run({"info", "--weld", "ball.off"}).exit_code, 0);
  EXPECT_EQ(run({"info", "--weld", "0.1", "ball.off"}).exit_code, 0);
}

TEST_F(Messages, RefusePicturesUnderNamesOfOtherFormats) {
  for (const std::string command : {"smooth", "fill"}) {
    expect({{{command, "ball.off", "o.off", "--picture", "x.jpg"},
             {"--picture: 'x.jpg' must end in .png", "PNG"}}});
    EXPECT_EQ(run({command, "ball.off", "o.off", "--picture", "x.PNG", "--overwrite"}).exit_code,
              0);
  }
}

TEST_F(Messages, NameTheOptionForAFormat) {
  for (const std::string command : {"info", "holes"}) {
    expect({{{command, "text.dat"}, {"text.dat: ", "--input-format", "ply, off, obj, stl"}, 3}});
    expect({{{command, "ball.off", "--input-format", "foo"}, {"--input-format", "'foo'", "ply"}}});
  }
  expect({
      {{"smooth", "ball.off", "o.foo"}, {"o.foo: 'foo'", "--format", "ply, off, obj, stl"}},
      {{"make", "torus", "o"}, {"--format", "ply, off, obj, stl"}},
      {{"view", "ball.off", "v.txt"}, {"'v.txt' must end in .html"}},
      {{"info", "ball.off", "--report", "r.txt"}, {"--report: 'r.txt'", ".json, .csv, .html"}},
  });
}

TEST_F(Messages, NameBothOptionsThatCannotBeCombined) {
  expect({
      {{"smooth", "ball.off", "o.off", "--keep-volume", "--max-move", "1"},
       {"--keep-volume", "--max-move"}},
      {{"smooth", "ball.off", "o.off", "--keep-sharp", "30", "--no-mass"},
       {"--keep-sharp", "--no-mass"}},
      {{"smooth", "ball.off", "o.off", "--keep-sharp", "30", "--laplacian", "umbrella"},
       {"--keep-sharp", "--laplacian: crouzeix-raviart"}},
      {{"smooth", "ball.off", "o.off", "--h0", "1"}, {"--h0", "--laplacian: lagrange"}},
      {{"smooth", "ball.off", "o.off", "--anisotropy", "1,0,0,2"},
       {"--anisotropy", "--laplacian: lagrange"}},
      {{"smooth", "ball.off", "o.off", "--time-step", "1", "--cutoff", "2"},
       {"--cutoff cannot be combined with --time-step"}},
      {{"info", "ball.off", "--mass", "voronoi"}, {"--mass needs --laplacian"}},
      {{"fill", "open.off", "o.off", "--region", "@all", "--only", "1"}, {"--only", "--region"}},
      {{"fill", "open.off", "o.off", "--continuity", "1", "--mass", "none"},
       {"--mass", "--continuity 1"}},
      {{"smooth", "ball.off"}, {"the argument OUT is missing"}},
      {{"smooth", "ball.off", "o.off", "--cutoff"}, {"--cutoff needs a value: LENGTH|auto"}},
      {{"smooth", "ball.off", "o.off", "--mass"}, {"--mass needs a value: one of ", ", voronoi"}},
      {{"compare", "ball.off", "--torus"}, {"--torus needs a value: R,r"}},
      {{"fill", "open.off", "o.off", "--all=x"}, {"--all takes no value", "'x'"}},
      {{"smooth", "ball.off", "o.off", "--steps", "1", "--steps", "2"},
       {"--steps is given 2 times"}},
  });
}

TEST_F(Messages, NameTheMeshWhoseGeometryIsRefused) {
  expect({
      {{"smooth", "open.off", "o.off", "--keep-volume"},
       {"open.off: ", "open boundaries: 2", "`ibmfair fill --all`"},
       4},
      {{"smooth", "tiny.off", "o.off"}, {"tiny.off: ", "too short", "scale the mesh"}, 4},
      {{"smooth", "defects.off", "o.off", "--strict"}, {"defects.off: ", "--strict", "(1)"}, 4},
      {{"compare", "flat.off", "ball.off"}, {"error: flat.off: ", "area"}, 4},
      {{"compare", "ball.off", "flat.off"}, {"error: flat.off: ", "area"}, 4},
      {{"compare", "flat.off", "--sphere", "fit"}, {"flat.off: ", "plane"}, 4},
      {{"fill", "one.obj", "o.obj", "--region", "a"}, {"--region", "border"}},
      {{"fill", "open.off", "o.off", "--only", "7"}, {"hole 7", "0 to 1", "`ibmfair holes`"}},
      {{"fill", "open.off", "o.off", "--edge-length", "1e-30"}, {"--edge-length: 1e-30", "least"}},
  });
}

TEST_F(Messages, NameTheFileOfAnOptionAndItsLine) {
  expect({
      {{"smooth", "ball.off", "o.off", "--weights", "words.txt"},
       {"--weights: words.txt:2: 'x'"},
       3},
      {{"smooth", "ball.off", "o.off", "--weights", "three.txt"},
       {"--weights: three.txt: the file has 3 numbers, but the mesh has 42 vertices"},
       3},
      {{"smooth", "ball.off", "o.off", "--fix", "far.txt"}, {"--fix: far.txt:1: '99999'", "41"}, 3},
      {{"smooth", "ball.off", "o.off", "--fix", "none.txt"},
       {"--fix: none.txt: cannot be read"},
       3},
      {{"batch", "none.json"}, {"none.json: cannot be read: No such file"}, 3},
      {{"smooth", "ball.off", "none/o.off"}, {"none/o.off: ", "there is no folder 'none'"}, 6},
  });
}

TEST_F(Messages, NameTheSettingOfAShape) {
  expect({
      {{"make", "icosphere", "o.off", "--rows", "3"}, {"takes no --rows", "--subdivide"}},
      {{"make", "icosphere", "o.off", "--subdivide", "14"}, {"--subdivide: 14", "12"}},
      {{"make", "torus", "o.off", "--rows", "1"}, {"--rows: 1", "without --straight"}},
      {{"make", "catenoid", "o.off", "--ratio", "30"}, {"--ratio: ", "20"}},
      {{"make", "icosphere", "o.off", "--refine-face", "99"}, {"--refine-face: ", "0 to 19"}},
      {{"make", "icosphere", "o.off", "--jitter", "1"}, {"--jitter: 1", "0.5"}},
      {{"make", "six-sided-hole", "o.off", "--subdivide", "0"}, {"--subdivide: "}},
  });
}

TEST_F(Messages, SayWhatFixesAllVertices) {
  struct Case {
    Words words;
    std::string cause;
  };
  write("mask.txt", "0 1\n");
  std::string all;
  for (int v = 0; v < 42; ++v) {
    all += std::to_string(v) + "\n";
  }
  write("all.txt", all);
  for (const Case& c :
       std::vector<Case>{{{"one.obj", "o.obj"}, "open boundaries (--boundary free lets them move)"},
                         {{"flat.off", "o.off", "--boundary", "free"}, "defects of the mesh"},
                         {{"ball.off", "o.off", "--fix", "all.txt"}, "--fix"}}) {
    const RunResult result = run(Words{"smooth"} + c.words + Words{"--overwrite"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(contains(result.err, "no vertex is free to move")) << result.err;
    EXPECT_TRUE(contains(result.err, "vertices are fixed by " + c.cause)) << result.err;
  }
}

TEST_F(Messages, WarnOfObjLinesWithUnknownKeywords) {
  write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nt 1//4 2 3\nf 1 2 4\n");
  for (const Words& words :
       {Words{"info", "odd.obj"}, Words{"holes", "odd.obj"}, Words{"smooth", "odd.obj", "o.obj"},
        Words{"fill", "odd.obj", "f.obj"}}) {
    const RunResult result = run(words + Words{"--report", "r.json", "--overwrite"});
    EXPECT_TRUE(contains(result.err, "warning: odd.obj:6:1: unknown keyword 't'")) << result.err;
    const auto report = nlohmann::json::parse(read_bytes(directory_ / "r.json"));
    EXPECT_EQ(report["unknown_statements"]["count"], 1);
    EXPECT_EQ(report["unknown_statements"]["first_line"], 6);
    EXPECT_EQ(report["unknown_statements"]["first_keyword"], "t");
    EXPECT_TRUE(contains(report["warnings"].dump(), "odd.obj:6:1")) << words.front();
  }
  EXPECT_TRUE(contains(read_bytes(directory_ / "o.obj"), "\nt 1//4 2 3\n"));
}

}  // namespace
}  // namespace ibmfair::test
