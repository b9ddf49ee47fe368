// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.
package terraline_pkg;

  // Words of 32 bits
  localparam int NARROW_WIDTH = 32;
  localparam int NARROW_VIEW_POINT = 30;
  localparam int NARROW_POINT = 20;

  // Words of 64 bits
  localparam int WIDE_WIDTH = 64;
  localparam int WIDE_VIEW_POINT = 38;
  localparam int WIDE_POINT = 24;

  // Registers: format with narrow and with wide words
  //   view_x        Q2.30   Q26.38  view vector along x, cells × 2^e
  //   view_y        Q2.30   Q26.38  view vector along y, height units × 2^e
  //   view_z        Q2.30   Q26.38  view vector along z, cells × 2^e
  //   denominator   Q2.30   Q26.38  s n·V / abs(F), positive towards the plane, 2^d
  //   ground_x      Q12.20  Q40.24  position, x, cells
  //   ground_z      Q12.20  Q40.24  position, z, cells
  //   dground_x     Q12.20  Q40.24  step, x, cells
  //   dground_z     Q12.20  Q40.24  step, z, cells
  //   ray_y         Q12.20  Q40.24  height of the ray, height units
  //   dray_y        Q12.20  Q40.24  step, y, height units
  //   node          Q12.20  Q40.24  node of the map, height units
  //   surface       Q12.20  Q40.24  surface height, height units
  //   slope_x       Q12.20  Q40.24  −∂y/∂x, 1
  //   slope_z       Q12.20  Q40.24  −∂y/∂z, 1
  //   weight        Q12.20  Q40.24  kernel weight, 1
  //   weight_slope  Q12.20  Q40.24  its derivative, 1/cell
  //   normal        Q12.20  Q40.24  normal, scaled below one, 1
  //   shade         Q12.20  Q40.24  ambient plus diffuse light; contrast, 1
  //   ramp          Q12.20  Q40.24  place on the ramp, segments
  //   channel       Q12.20  Q40.24  colour channel, 0..=255

  // Cycles (docs/cycles.md)
  localparam int PROJECTOR_LATENCY = 1;  // L of the projector
  localparam int PROJECTOR_DEPTH = 2;  // D of the projector
  localparam int DIVIDER_ENDS = 3;  // stages of the divider besides one per quotient bit
  localparam int STEPPER_DEPTH = 2;  // D of the stepper and of the serial divider
  localparam int RAY_START = 4;  // cycles to turn a view vector into a step and to begin with it
  localparam int RAY_END = 2;  // cycles of a hit besides its bisection steps
  localparam int KERNEL_LATENCY = 2;  // cycles of kernel ROM and hat weight
  localparam int LERP_LATENCY = 5;  // stages of a height behind nodes and weights
  localparam int SLOPE_LATENCY = 2;  // stages of the slopes' factors
  localparam int SHADER_LATENCY = 13;  // L of the shader
  localparam int SHADER_DEPTH = 14;  // D of the shader

  // Addresses of coefficients
  localparam int ADDRESS_COLUMNS = 0;
  localparam int ADDRESS_LINES = 1;
  localparam int ADDRESS_VIEW_X_START = 2;
  localparam int ADDRESS_VIEW_X_PER_LINE = 3;
  localparam int ADDRESS_VIEW_X_PER_COLUMN = 4;
  localparam int ADDRESS_VIEW_Y_START = 5;
  localparam int ADDRESS_VIEW_Y_PER_LINE = 6;
  localparam int ADDRESS_VIEW_Y_PER_COLUMN = 7;
  localparam int ADDRESS_VIEW_Z_START = 8;
  localparam int ADDRESS_VIEW_Z_PER_LINE = 9;
  localparam int ADDRESS_VIEW_Z_PER_COLUMN = 10;
  localparam int ADDRESS_DENOMINATOR_START = 11;
  localparam int ADDRESS_DENOMINATOR_PER_LINE = 12;
  localparam int ADDRESS_DENOMINATOR_PER_COLUMN = 13;
  localparam int ADDRESS_EYE_X = 14;
  localparam int ADDRESS_EYE_Z = 15;
  localparam int ADDRESS_RATIO_SHIFT_X = 16;
  localparam int ADDRESS_RATIO_BITS_X = 17;
  localparam int ADDRESS_FROM_EYE = 18;
  localparam int ADDRESS_EYE_Y = 19;
  localparam int ADDRESS_HIGHEST = 20;
  localparam int ADDRESS_BASE = 21;
  localparam int ADDRESS_FINENESS = 22;
  localparam int ADDRESS_LAST = 23;
  localparam int ADDRESS_BISECTION_FIXED = 24;
  localparam int ADDRESS_BISECTION_BIAS = 25;
  localparam int ADDRESS_BISECTION_CAP = 26;
  localparam int ADDRESS_SKIPPING = 27;
  localparam int ADDRESS_PYRAMID_TOP = 28;
  localparam int ADDRESS_BEYOND_SKY = 29;
  localparam int ADDRESS_MAP_COLUMNS = 30;
  localparam int ADDRESS_MAP_ROWS = 31;
  localparam int ADDRESS_MAP_EDGE = 32;
  localparam int ADDRESS_SIDES = 33;
  localparam int ADDRESS_VOID_BITS = 34;
  localparam int ADDRESS_FORM = 35;
  localparam int ADDRESS_DEFORMATION_SHIFT = 36;
  localparam int ADDRESS_KERNEL_LOG2 = 37;
  localparam int ADDRESS_SLOPE_SCALED = 38;
  localparam int ADDRESS_SLOPE_SCALE_X = 39;
  localparam int ADDRESS_SLOPE_SCALE_Z = 40;
  localparam int ADDRESS_MEMORY_LATENCY = 41;
  localparam int ADDRESS_SKY_COLOR = 42;
  localparam int ADDRESS_OUT_OF_RANGE_COLOR = 43;
  localparam int ADDRESS_SIDE_COLOR = 44;
  localparam int ADDRESS_LIT = 45;
  localparam int ADDRESS_LIGHT_X = 46;
  localparam int ADDRESS_LIGHT_Y = 47;
  localparam int ADDRESS_LIGHT_Z = 48;
  localparam int ADDRESS_AMBIENT = 49;
  localparam int ADDRESS_RAMP_EXPONENT = 50;
  localparam int ADDRESS_RAMP_GAIN = 51;
  localparam int ADDRESS_RAMP_LAST = 52;
  localparam int ADDRESS_MEAN_RED = 53;
  localparam int ADDRESS_MEAN_GREEN = 54;
  localparam int ADDRESS_MEAN_BLUE = 55;
  localparam int ADDRESS_SWING_RED = 56;
  localparam int ADDRESS_SWING_GREEN = 57;
  localparam int ADDRESS_SWING_BLUE = 58;
  localparam int ADDRESS_CONTRAST_EXPONENT = 59;
  localparam int ADDRESS_CONTRAST_GAIN = 60;
  localparam int ADDRESS_FULL_FROM_FITTED = 61;
  localparam int ADDRESS_FULL_FROM = 62;
endpackage
