# Everything that comes from elsewhere. The packages are in docker/packages.txt; who may include what is
# checked by tests/layers.

find_package(Threads REQUIRED)
find_package(OpenSubdiv 3.5 REQUIRED)                 # OpenSubdiv::osdCPU             core/oracle
find_package(nlohmann_json 3.11 CONFIG REQUIRED)      # nlohmann_json::nlohmann_json   proto
find_package(TinyGLTF 2.7 CONFIG REQUIRED)            # TinyGLTF::TinyGLTF             proto
find_package(CppHttplib 0.11 REQUIRED)                # CppHttplib::CppHttplib         server
find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto)  # OpenSSL::Crypto                server
find_package(spdlog 1.10 CONFIG REQUIRED)             # spdlog::spdlog                 server
find_package(CLI11 2.1 CONFIG REQUIRED)               # CLI11::CLI11                   server

if(SUBDIVD_TESTS)
  find_package(GTest 1.12 CONFIG REQUIRED)      # GTest::gtest GTest::gmock GTest::gtest_main
  find_package(rapidcheck CONFIG REQUIRED)      # rapidcheck
  find_package(benchmark 1.7 CONFIG REQUIRED)   # benchmark::benchmark benchmark::benchmark_main
endif()
