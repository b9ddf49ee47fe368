// The back end of a plane: the checker, with the bank of its coefficients. A plane has no memory and no
// walk: the divider's place is the hit.
//
// Never reads a memory, never has a side to draw: pixels are surface, sky or out of range.
module plane_back #(
    parameter int WIDE = 0,  // words of 64 bits, not 32
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input  logic                clock,             // rising edge
    input  logic                reset,             // forgets all items
    // Loading
    input  logic                load_coefficient,  // take `load_data` at this edge
    input  logic        [ 15:0] load_address,      // coefficient
    input  logic        [W-1:0] load_data,         // word
    // Items from the front end
    input  logic                in_valid,          // an item is there
    output logic                in_ready,          // it is taken at this edge
    input  logic        [  1:0] in_entry,          // 0 met, 1 sky, 2 out of range
    input  logic signed [W-1:0] in_ground_x,       // where the ray meets the plane, x in squares
    input  logic signed [W-1:0] in_ground_z,       // z
    input  logic signed [W-1:0] in_denominator,    // positive towards the plane
    // Pixels
    output logic                out_valid,         // a pixel is there
    input  logic                out_ready,         // it is taken at this edge
    output logic        [ 23:0] out_color,         // sRGB bytes, red in the low byte
    output logic        [  1:0] out_hit            // 0 sky, 1 surface, 3 out of range
);
  logic [23:0] sky_color;
  logic [23:0] out_of_range_color;
  logic signed [W-1:0] mean_red;
  logic signed [W-1:0] mean_green;
  logic signed [W-1:0] mean_blue;
  logic signed [W-1:0] swing_red;
  logic signed [W-1:0] swing_green;
  logic signed [W-1:0] swing_blue;
  logic signed [7:0] contrast_exponent;
  logic signed [W-1:0] contrast_gain;
  logic full_from_fitted;
  logic signed [W-1:0] full_from;

  registers_checker #(
      .WIDE(WIDE)
  ) registers (
      .clock(clock),
      .load(load_coefficient),
      .load_address(load_address),
      .load_data(load_data),
      .sky_color(sky_color),
      .out_of_range_color(out_of_range_color),
      .mean_red(mean_red),
      .mean_green(mean_green),
      .mean_blue(mean_blue),
      .swing_red(swing_red),
      .swing_green(swing_green),
      .swing_blue(swing_blue),
      .contrast_exponent(contrast_exponent),
      .contrast_gain(contrast_gain),
      .full_from_fitted(full_from_fitted),
      .full_from(full_from)
  );
  checkers #(
      .WIDE(WIDE)
  ) checkers (
      .clock(clock),
      .reset(reset),
      .sky_color(sky_color),
      .out_of_range_color(out_of_range_color),
      .mean_red(mean_red),
      .mean_green(mean_green),
      .mean_blue(mean_blue),
      .swing_red(swing_red),
      .swing_green(swing_green),
      .swing_blue(swing_blue),
      .contrast_exponent(contrast_exponent),
      .contrast_gain(contrast_gain),
      .full_from(full_from),
      .full_from_fitted(full_from_fitted),
      .in_valid(in_valid),
      .in_ready(in_ready),
      .in_entry(in_entry),
      .in_ground_x(in_ground_x),
      .in_ground_z(in_ground_z),
      .in_denominator(in_denominator),
      .in_tag(1'b0),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_color(out_color),
      .out_hit(out_hit),
      .out_tag()
  );
endmodule
