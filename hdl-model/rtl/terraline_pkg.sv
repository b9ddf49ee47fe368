// placeholder
package terraline_pkg;
  localparam int LERP_LATENCY = 5;
endpackage
