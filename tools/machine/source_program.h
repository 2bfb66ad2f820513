#pragma once
// The program of the source's section 4 for runs without a file: controllers/gcode/examples/channel.ngc and
// channel_saving.ngc, which a test holds equal to these.

namespace feedtwin::tools {

extern const char* const source_program_A;
extern const char* const source_program_B;

}  // namespace feedtwin::tools
