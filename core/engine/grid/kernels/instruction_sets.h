#pragma once
// Which of the loops' copies runs: they are compiled once for every processor, and again for newer ones.

namespace subdivd::kernels {

// Numbered from the one that every processor has, "baseline", to the best.
inline constexpr int kInstructionSets = 3;
bool has_instruction_set(int set);
// The best that this processor has, or what was forced.
int instruction_set();
// For tests: the answer must not depend on it. -1: the best.
void force_instruction_set(int set);

}  // namespace subdivd::kernels
