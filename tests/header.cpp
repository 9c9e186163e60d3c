// Compiles the header that is precompiled for the tests (CMakeLists.txt).
