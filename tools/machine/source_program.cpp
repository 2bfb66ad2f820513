#include "tools/machine/source_program.h"

namespace feedtwin::tools {

const char* const source_program_A =
    R"ngc((The straight channel of the source's section 4, case A: pump and spindle run from the start)
(A flat-end mill of 4 mm, 3000 rpm, 6 mm/s; two corners in the block, two outside on the way back)
G21 G17 G90 G94 G64
S3000 M3 M8
G0 X0 Y0 Z-0.225
G4 P0.7 (spindle up to speed)
G1 X44.2 F360
Y12
X-31.4
M5 (clear of the block)
Y0
X0
M9
M2
)ngc";

const char* const source_program_B =
    R"ngc((The same channel, case B: the pump runs while cutting only, and the spindle is slow outside the cut)
G21 G17 G90 G94 G64
S3000 M3 M8
G0 X0 Y0 Z-0.225
G4 P0.7 (spindle up to speed)
G1 X44.2 F360
Y12
X3.2 (the tool leaves the block)
S600 M9
X-31.4
M5
Y0
X0
M2
)ngc";

}  // namespace feedtwin::tools
