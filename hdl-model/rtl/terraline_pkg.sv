// placeholder
package terraline_pkg;
  localparam int LERP_LATENCY = 5;
  localparam int NARROW_WIDTH = 32;
  localparam int NARROW_VIEW_POINT = 30;
  localparam int NARROW_POINT = 20;
  localparam int WIDE_WIDTH = 64;
  localparam int WIDE_VIEW_POINT = 38;
  localparam int WIDE_POINT = 24;
endpackage
