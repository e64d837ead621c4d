// Reports of solves, and options for the method.
#include <gtest/gtest.h>

#include "subcommands.h"

namespace reports_test {
namespace {

class SolverOptionsOfCommands : public Subcommands {
 protected:
  /// Arguments that run a command on a sphere of 500 points.
  std::vector<std::string> on(std::vector<std::string> arguments, const std::vector<std::string>& options) const {
    arguments.insert(arguments.end(), {"--operator", in("sphere")});
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  void SetUp() override {
    run({"laplacian", dir_.write("sphere.xyz", sphere(500)), "--format", "npz,ply,cover", "--out", in("sphere")});
  }
};

TEST_F(SolverOptionsOfCommands, EveryReportNamesMethodIterationsResidualAndSeconds) {
  const std::vector<std::vector<std::string>> spectral = {{"spectrum", "--count", "10"},
                                                          {"hks", "--count", "10"},
                                                          {"embed"},
                                                          {"filter", "--positions", "--count", "10"},
                                                          {"operators", "--count", "10"}};
  const std::vector<std::vector<std::string>> solves = {{"distance", "--source", "0", "--method", "heat"},
                                                        {"interpolate", "--pin", "0=1", "--pin", "1=2"},
                                                        {"poisson", "--field", "z"},
                                                        {"poisson", "--field", "z", "--pin", "0=1"},
                                                        {"green", "--source", "0"}};
  for (const std::string solver : {"cholesky", "multigrid"}) {
    const std::string method = solver == "cholesky" ? "Cholesky" : "multigrid";
    for (const auto& arguments : spectral) {
      run(on(arguments, {"--solver", solver, "--out", in(arguments[0] + solver)}));
      expectReport(arguments[0] + solver, method, true);
    }
    for (const auto& arguments : solves) {
      run(on(arguments, {"--solver", solver, "--out", in(arguments[0] + solver)}));
      expectReport(arguments[0] + solver, method, solver == "multigrid");
    }
    EXPECT_GT(report("operators" + solver)["gradients"]["seconds"], 0);
  }
}

TEST_F(SolverOptionsOfCommands, MemoryDecidesUnlessAMethodIsNamed) {
  const std::vector<std::string> harmonic = {"interpolate", "--pin", "0=1", "--pin", "1=2"};
  const auto expectMethod = [&](const std::vector<std::string>& options, const std::string& method) {
    std::vector<std::string> arguments = on(harmonic, options);
    arguments.insert(arguments.end(), {"--out", in("out")});
    run(arguments);
    expectReport("out", method, method == "multigrid");
  };
  expectMethod({}, "Cholesky");
  expectMethod({"--memory-limit", "1kB"}, "multigrid");
  expectMethod({"--memory-limit", "1000"}, "multigrid");
  expectMethod({"--memory-limit", "1.5GiB"}, "Cholesky");
  expectMethod({"--memory-limit", "1kB", "--solver", "automatic"}, "multigrid");
  expectMethod({"--memory-limit", "1kB", "--solver", "cholesky"}, "Cholesky");
  run(on({"spectrum", "--memory-limit", "1kB"}, {"--out", in("spectrum")}));
  expectReport("spectrum", "multigrid", true);
}

TEST_F(SolverOptionsOfCommands, AreNamedInHelpByTheWordsOfMessages) {
  const std::vector<std::string> bending = {"interpolate", "--pin", "0=1", "--pin", "1=2", "--method", "biharmonic"};
  expectRefusal(on(bending, {"--memory-limit", "1kB"}), "raise memory_limit or set method", 1);
  expectRefusal(on(bending, {"--solver", "multigrid"}), "set method to SolverMethod::cholesky", 1);
  run(on(bending, {"--memory-limit", "1kB", "--solver", "cholesky", "--out", in("out")}));
  const std::string help = run({"interpolate", "--help"}).out;
  EXPECT_NE(help.find("memory_limit in messages"), std::string::npos) << help;
  EXPECT_NE(help.find("SolverMethod in messages"), std::string::npos) << help;
  expectRefusal(on({"spectrum"}, {"--solver", "lu"}), "--solver");
  for (const char* size : {"0", "-1", "nan", "much", "GB", "1parsec", "1e30", "99999999999GB"})
    expectRefusal(on({"spectrum"}, {"--memory-limit", size}), "--memory-limit");
}

}  // namespace
}  // namespace reports_test
