// Shell completions, tried in the shells that they are written for.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/run_program.h"
#include "support/shell.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

/// The words of a command line; the last one, which may be empty, is to be completed.
struct CompletionCase {
  Words words;
  std::vector<std::string> offered;
  std::vector<std::string> not_offered;
};

const std::vector<CompletionCase>& completion_cases() {
  static const std::vector<CompletionCase> cases{
      {{""}, {"smooth", "fill", "make", "batch", "help"}, {"scan.ply"}},
      {{"smo"}, {"smooth"}, {"fill", "scan.ply"}},
      {{"help", ""}, {"smooth", "compare"}, {"scan.ply"}},
      {{"smooth", "--cu"}, {"--cutoff"}, {"--steps", "scan.ply"}},
      {{"smooth", "scan.ply", "--pl"}, {"--plain"}, {"--cutoff"}},
      {{"fill", "--no-"}, {"--no-fair", "--no-refine", "--no-mass"}, {"--plain"}},
      {{"smooth", "--laplacian", ""}, {"crouzeix-raviart", "lagrange"}, {"scan.ply", "--cutoff"}},
      {{"smooth", "--mass", ""}, {"barycentric", "voronoi"}, {"scan.ply", "--cutoff"}},
      {{"smooth", "--solver", "c"}, {"cholmod", "cg"}, {"auto", "scan.ply"}},
      {{"smooth", "--input-format", "o"}, {"obj", "off"}, {"ply"}},
      {{"make", ""}, {"icosphere", "torus"}, {"scan.ply", "smooth"}},
      {{"make", "torus", ""}, {"scan.ply"}, {"icosphere"}},
      {{"smooth", "s"}, {"scan.ply"}, {"smooth"}},
      {{"smooth", "scan.ply", "sp"}, {"spare.ply"}, {"smooth"}},
      {{"smooth", "--fix", "s"}, {"scan.ply", "scan.txt"}, {}},
      {{"smooth", "--out-dir", "s"}, {"sub/"}, {"scan.ply"}},
      {{"batch", "jo"}, {"jobs.json"}, {"scan.ply"}},
      {{"--generate", ""}, {"man", "bash", "zsh", "fish"}, {"smooth"}},
  };
  return cases;
}

class Completion : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"scan.ply", "scan.txt", "spare.ply", "jobs.json", "sub/inner.obj"}) {
      if (std::string(name).starts_with("sub")) {
        run_shell("mkdir sub", folder());
      }
      write_bytes(directory_ / name, "");
    }
    for (const std::string shell : {"bash", "zsh", "fish"}) {
      const RunResult script = run_program({"--generate", shell});
      EXPECT_EQ(script.exit_code, 0);
      write_bytes(scripts_ / (shell == "zsh" ? "_ibmfair" : shell), script.out);
    }
  }

  std::string folder() const { return directory_.path().string(); }

  /// Checks the words that a shell offers, one word per line, for every case.
  template <class Offers>
  void check(const Offers& offers) const {
    for (const CompletionCase& test : completion_cases()) {
      std::string line;
      for (const std::string& word : test.words) {
        line += " " + word;
      }
      SCOPED_TRACE(line);
      const std::string out = "\n" + offers(test.words);
      for (const std::string& word : test.offered) {
        // Some shells add the slash behind a folder only later.
        const std::string name = word.ends_with('/') ? word.substr(0, word.size() - 1) : word;
        EXPECT_TRUE(contains(out, "\n" + name)) << "no " << word << " in" << out;
      }
      for (const std::string& word : test.not_offered) {
        EXPECT_FALSE(contains(out, "\n" + word + "\n")) << word << " in" << out;
      }
    }
  }

  const TemporaryDirectory directory_, scripts_;
};

TEST_F(Completion, WorksInBash) {
  if (!is_installed("bash")) {
    GTEST_SKIP() << "no bash";
  }
  const auto offers = [&](const Words& words) {
    std::string line = "ibmfair";
    for (const std::string& word : words) {
      line += " " + shell_quoted(word);
    }
    const ShellResult result =
        run_shell("bash --norc -uc " +
                      shell_quoted("source " + shell_quoted(scripts_ / "bash") + "; COMP_WORDS=(" +
                                   line + "); COMP_CWORD=" + std::to_string(words.size()) +
                                   R"(; _ibmfair; printf '%s\n' "${COMPREPLY[@]}")"),
                  folder());
    EXPECT_EQ(result.exit_code, 0) << result.out;
    return result.out;
  };
  check(offers);
  EXPECT_EQ(offers({"smooth", "--laplacian", "=", "l"}), "lagrange\n");
  EXPECT_EQ(offers({"smooth", "--laplacian", "="}),
            "crouzeix-raviart\nlagrange\nweighted\nintrinsic-delaunay\numbrella\n");
  // Meshes are offered first; other files are offered only if no mesh has such a name.
  EXPECT_EQ(offers({"smooth", "sc"}), "scan.ply\n");
  EXPECT_EQ(offers({"smooth", "scan.t"}), "scan.txt\n");
  EXPECT_EQ(offers({"make", "--ratio", "2", "tor"}), "torus\n");
}

TEST_F(Completion, WorksInFish) {
  if (!is_installed("fish")) {
    GTEST_SKIP() << "no fish";
  }
  const auto offers = [&](const Words& words) {
    std::string line = "ibmfair";
    for (const std::string& word : words) {
      line += " " + word;
    }
    const ShellResult result =
        run_shell("HOME=" + shell_quoted(scripts_.path().string()) + " fish --no-config -c " +
                      shell_quoted("source " + shell_quoted(scripts_ / "fish") + "; complete -C " +
                                   shell_quoted(line)) +
                      " | cut -f 1",
                  folder());
    EXPECT_EQ(result.exit_code, 0) << result.out;
    return result.out;
  };
  check(offers);
  EXPECT_TRUE(contains(offers({"smooth", "--laplacian=l"}), "--laplacian=lagrange"));
  EXPECT_TRUE(contains(offers({"smooth", "-q", "--verb"}), "--verbose"));
}

TEST_F(Completion, WorksInZsh) {
  if (!is_installed("zsh")) {
    GTEST_SKIP() << "no zsh";
  }
  struct Typed {
    std::string line, completed;
  };
  for (const Typed& typed : std::vector<Typed>{
           {"ibmfair smo", "ibmfair smooth "},
           {"ibmfair help comp", "ibmfair help compare "},
           {"ibmfair --gen", "ibmfair --generate="},
           {"ibmfair smooth --cut", "ibmfair smooth --cutoff="},
           {"ibmfair fill scan.ply --no-re", "ibmfair fill scan.ply --no-refine "},
           {"ibmfair smooth --solver cho", "ibmfair smooth --solver cholmod "},
           {"ibmfair smooth --laplacian=l", "ibmfair smooth --laplacian=lagrange "},
           {"ibmfair make toru", "ibmfair make torus "},
           {"ibmfair smooth sc", "ibmfair smooth scan.ply "},
           {"ibmfair smooth scan.ply sp", "ibmfair smooth scan.ply spare.ply "},
           {"ibmfair smooth --fix scan.t", "ibmfair smooth --fix scan.txt "},
           {"ibmfair smooth --out-dir s", "ibmfair smooth --out-dir sub/"},
           {"ibmfair batch jo", "ibmfair batch jobs.json "},
       }) {
    const ShellResult result =
        run_shell("timeout 600 zsh -f " + shell_quoted(project_file("tests/support/complete.zsh")) +
                      " " + shell_quoted(scripts_.path().string()) + " " + shell_quoted(typed.line),
                  folder());
    EXPECT_EQ(result.exit_code, 0) << typed.line;
    EXPECT_EQ(result.out, typed.completed + "\n");
  }
}

}  // namespace
}  // namespace ibmfair::test
