/* @TITLE@: forward and inverse kinematics in doubles, with proved bounds.
   Written by certify-poses codegen from @SOURCE@. C99, no allocation, no state of its own.

   Joint values: @VALUES@.
   Positions are in @UNIT@, ordinary coordinates; quaternions have the scalar first.
   Do not compile with -ffast-math: the proofs need IEEE arithmetic. The platform's sin and cos are taken to be right
   to two units of the last place. */
#ifndef @GUARD@
#define @GUARD@

#define @MACRO@_JOINTS @M@
#define @MACRO@_SIZE @N@

enum {
    @MACRO@_NOT_PROVED = 0, /* nothing is proved; the pose is not changed */
    @MACRO@_PROVED = 1,     /* exactly one pose for the joint values is within the bounds, and it is not singular */
    @MACRO@_SAME_MODE = 2   /* so it is, and poses that are not singular join the last one to it */
};

typedef struct {
    double position[3];
    double rotation[9];   /* by rows */
    double quaternion[4]; /* unit */
    double position_bound; /* no coordinate is farther from the true one */
    double rotation_bound; /* no entry of the rotation matrix is farther from the true one */
    double values[@M@];   /* the joint values it belongs to */
    double point[@N@];    /* Study coordinates, and how far the true ones are, at most */
    double radius;
} @NAME@_pose;

/* The pose near a position and quaternion (of any norm) for joint values; PROVED or NOT_PROVED. */
int @NAME@_start(const double values[@M@], const double position[3], const double quaternion[4], @NAME@_pose *pose);

/* The pose for new joint values, near the last one, in its place. All joint values on the way, each going evenly from the
   last to the new one, are looked at in one step: where it says PROVED only, try smaller steps. */
int @NAME@_follow(const double values[@M@], @NAME@_pose *pose);

/* Joint values at a pose, those next to `near` where there are two; 0, or the number of the first leg out of reach. */
int @NAME@_inverse(const double position[3], const double quaternion[4], const double near[@M@], double values[@M@]);

#endif
