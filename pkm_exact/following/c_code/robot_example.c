/* @TITLE@: how to use it. cc -std=c99 -O2 @NAME@_example.c @NAME@.c -lm -o @NAME@_example && ./@NAME@_example */
#include <stdio.h>

#include "@NAME@.h"

int main(void) {
    const double position[3] = @HOME_POSITION@, quaternion[4] = @HOME_QUATERNION@;
    double values[@MACRO@_JOINTS] = @HOME_VALUES@;
    @NAME@_pose pose;
    if (@NAME@_start(values, position, quaternion, &pose) == @MACRO@_NOT_PROVED) return 1;
    for (int step = 0; step < 10; step++) {
        values[0] += @STEP@;
        int proved = @NAME@_follow(values, &pose);
        printf("%2d: (%.9g, %.9g, %.9g) +- %.1e, %s\n", step, pose.position[0], pose.position[1], pose.position[2],
               pose.position_bound, proved == @MACRO@_SAME_MODE ? "same mode" : proved ? "proved" : "not proved");
    }
    return 0;
}
