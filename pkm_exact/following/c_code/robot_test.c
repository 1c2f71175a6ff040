/* @TITLE@: forward kinematics against inverse kinematics at 10,000 random poses near home; exit code 0 if all agree.
   cc -std=c99 -O2 @NAME@_test.c @NAME@.c -lm -o @NAME@_test && ./@NAME@_test */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "@NAME@.h"

#define POSES 10000

static unsigned long long state = 1;

/* An even number from -1 to 1, always the same ones. */
static double even(void) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) / 4503599627370496.0 - 1.0;
}

int main(void) {
    const double position[3] = @HOME_POSITION@, quaternion[4] = @HOME_QUATERNION@, home_values[@MACRO@_JOINTS] = @HOME_VALUES@;
    const double moves[3] = @MOVES@, turns[4] = @TURNS@;
    static double values[POSES][@MACRO@_JOINTS], wanted[POSES][3];
    static @NAME@_pose found[POSES];
    @NAME@_pose home;
    int proved = 0, same = 0, wrong = 0, out = 0;
    if (@NAME@_start(home_values, position, quaternion, &home) == @MACRO@_NOT_PROVED) {
        puts("nothing is proved of the home pose");
        return 1;
    }
    for (int n = 0; n < POSES; n++) {
        double q[4];
        for (int i = 0; i < 3; i++) wanted[n][i] = home.position[i] + moves[i] * even();
        for (int i = 0; i < 4; i++) q[i] = home.quaternion[i] + turns[i] * even();
        if (@NAME@_inverse(wanted[n], q, home_values, values[n])) out++, memcpy(values[n], home_values, sizeof home_values), memcpy(wanted[n], home.position, sizeof home.position);
    }
    clock_t begin = clock();
    for (int n = 0; n < POSES; n++) {
        found[n] = home;
        int claim = @NAME@_follow(values[n], &found[n]);
        proved += claim != @MACRO@_NOT_PROVED;
        same += claim == @MACRO@_SAME_MODE;
        if (claim == @MACRO@_NOT_PROVED) found[n].position_bound = -1;
    }
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    for (int n = 0; n < POSES; n++)
        for (int i = 0; i < 3; i++)
            if (found[n].position_bound >= 0 && fabs(found[n].position[i] - wanted[n][i]) > found[n].position_bound + @ROOM@) {
                wrong++;
                break;
            }
    printf("%d poses: %d proved, %d of them of the same mode as home, %d out of reach, %d wrong; %.2f microseconds a pose\n", POSES, proved, same, out, wrong, 1e6 * seconds / POSES);
    return wrong != 0;
}
