// fuzz.h: what a fuzz target provides: libFuzzer's entry, and inputs to start from.
//
// A target must return 0 for any input: no crash, no hang, no memory beyond the stated limits.
// Errors that the library throws for bad input (ninefold::Error) are caught by the target.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

// Good inputs, which the replay program mutates. A target that has none starts from random bytes.
std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds();
