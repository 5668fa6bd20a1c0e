// SPDX-License-Identifier: MIT
// The axes of an orbit.
#ifndef SCENE_ORBIT_H
#define SCENE_ORBIT_H

#include "camera.h"

/// Write the directions in the world that are right, up and back in a picture taken from the orbit.
void scene_orbit_axes(const struct scene_orbit *orbit, double right[3], double up[3], double back[3]);

#endif
