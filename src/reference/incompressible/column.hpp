// A column of water of an ideal fluid, -length < x < 0 and 0 < y < height, the moment its gate at x = 0 is
// gone: the accelerations of its free face and top (Pohle 1952, Stoker 1957; the series of the finite
// column). Both are infinite at the face's foot (0, 0); the top's corner falls freely.
#pragma once

namespace freshet {

struct WaterColumn {
  double length = 1, height = 1;  // m
  double gravity = 9.81;          // m/s2
};

// m/s2, along x, of the face at 0 < y <= height.
double face_acceleration(const WaterColumn& column, double y);

// m/s2, along y, of the top at -length <= x <= 0.
double top_acceleration(const WaterColumn& column, double x);

// Pa per kg/m3: pressure / density inside.
double column_pressure(const WaterColumn& column, double x, double y);

}  // namespace freshet
