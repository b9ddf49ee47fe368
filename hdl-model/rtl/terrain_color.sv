// The third and last stage of a height map: the shader, with the bank of its coefficients.
//
// Never shows the surface of a pixel without a hit: that has a constant colour.
module terrain_color #(
    parameter int WIDE = 0,  // words of 64 bits, not 32
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input  logic                clock,             // rising edge
    input  logic                reset,             // forgets all items
    // Loading
    input  logic                load_coefficient,  // take `load_data` at this edge as a coefficient
    input  logic                load_rsqrt,        // as a reciprocal square root
    input  logic                load_ramp,         // as a colour of the ramp
    input  logic        [ 15:0] load_address,      // coefficient, or entry of the table
    input  logic        [W-1:0] load_data,         // word
    // Items from the interpolator
    input  logic                in_valid,          // an item is there
    output logic                in_ready,          // it is taken at this edge
    input  logic        [  1:0] in_hit,            // 0 sky, 1 surface, 2 side, 3 out of range
    input  logic signed [W-1:0] in_surface,        // surface height
    input  logic signed [W-1:0] in_slope_x,        // slope against x, negated
    input  logic signed [W-1:0] in_slope_z,        // against z
    // Pixels
    output logic                out_valid,         // a pixel is there
    input  logic                out_ready,         // it is taken at this edge
    output logic        [ 23:0] out_color,         // sRGB bytes, red in the low byte
    output logic        [  1:0] out_hit            // outcome
);
  logic [23:0] sky_color;
  logic [23:0] out_of_range_color;
  logic [23:0] side_color;
  logic lit;
  logic signed [W-1:0] light_x;
  logic signed [W-1:0] light_y;
  logic signed [W-1:0] light_z;
  logic signed [W-1:0] ambient;
  logic signed [7:0] ramp_exponent;
  logic signed [W-1:0] ramp_gain;
  logic [3:0] ramp_last;

  registers_shader #(
      .WIDE(WIDE)
  ) registers (
      .clock(clock),
      .load(load_coefficient),
      .load_address(load_address),
      .load_data(load_data),
      .sky_color(sky_color),
      .out_of_range_color(out_of_range_color),
      .side_color(side_color),
      .lit(lit),
      .light_x(light_x),
      .light_y(light_y),
      .light_z(light_z),
      .ambient(ambient),
      .ramp_exponent(ramp_exponent),
      .ramp_gain(ramp_gain),
      .ramp_last(ramp_last)
  );
  shader #(
      .WIDE(WIDE)
  ) shader (
      .clock(clock),
      .reset(reset),
      .sky_color(sky_color),
      .out_of_range_color(out_of_range_color),
      .side_color(side_color),
      .lit(lit),
      .toward_x(light_x),
      .toward_y(light_y),
      .toward_z(light_z),
      .ambient(ambient),
      .ramp_exponent(ramp_exponent),
      .ramp_gain(ramp_gain),
      .ramp_last(ramp_last),
      .load_rsqrt(load_rsqrt),
      .load_ramp(load_ramp),
      .load_address(load_address),
      .load_data(load_data),
      .in_valid(in_valid),
      .in_ready(in_ready),
      .in_hit(in_hit),
      .in_surface(in_surface),
      .in_slope_x(in_slope_x),
      .in_slope_z(in_slope_z),
      .in_tag(1'b0),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_color(out_color),
      .out_hit(out_hit),
      .out_tag()
  );
endmodule
