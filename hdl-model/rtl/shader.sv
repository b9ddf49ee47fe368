// The shader: the colour of a pixel of a height map (docs/units/mixer.md). Light and ramp side by side,
// mixer and pixel behind them are one stage of the chain; here is what goes along with their pixels.
//
// Cycles: one item per cycle. An item taken in cycle t is at the output in cycle t + 13 (L = 13:
// twelve stages and the put into the queue); at most D = 14 items are held. The stages:
//
//   1 .. 11  light: slopes to shade       ramp: height to albedo
//   12       mixer: albedo x shade, sums of rows
//   13       mixer: their sum; pixel: rounded to bytes, constant colours; into the queue
//
// Never divides, never stalls inside; tables and coefficients do not change while items are held.
module shader #(
    parameter int WIDE       = 0,   // 0: words of 32 bits, 1: of 64
    parameter int RSQRT_LOG2 = 10,  // table entries per unit, as a power of two; even
    parameter int SEGMENTS   = 15,  // most segments of the ramp, up to 15
    parameter int TAG        = 1,   // bits that go along with an item
    localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input logic clock,
    input logic reset,                              // no items are held

    // Coefficients.
    input logic        [ 23:0] sky_color,           // colours, red in the low byte: nothing is met
    input logic        [ 23:0] out_of_range_color,  // out of range
    input logic        [ 23:0] side_color,          // the side of the map
    input logic                lit,                 // the light is fitted; without it shade is one
    input logic signed [W-1:0] toward_x,            // direction to the light times diffuse share, x
    input logic signed [W-1:0] toward_y,            // y
    input logic signed [W-1:0] toward_z,            // z
    input logic signed [W-1:0] ambient,             // ambient share
    input logic signed [  7:0] ramp_exponent,       // power of two on heights; beyond 8 bits, its limit
    input logic signed [W-1:0] ramp_gain,           // segments per shifted height
    input logic        [  3:0] ramp_last,           // segments minus one

    // Tables.
    input logic         load_rsqrt,                 // write `load_data` to the reciprocal square roots
    input logic         load_ramp,                  // write `load_data` to the ramp
    input logic [ 15:0] load_address,               // entry; of the ramp segment*8 + channel*2 + (0 start, 1 rise)
    input logic [W-1:0] load_data,                  // tone word

    // Items.
    input  logic                  in_valid,
    output logic                  in_ready,
    input  logic        [    1:0] in_hit,           // 0 sky, 1 surface, 2 side, 3 out of range
    input  logic signed [  W-1:0] in_surface,       // height above the lowest node
    input  logic signed [  W-1:0] in_slope_x,       // normal, x; its vertical component is one
    input  logic signed [  W-1:0] in_slope_z,       // normal, z
    input  logic        [TAG-1:0] in_tag,           // goes along
    output logic                  out_valid,
    input  logic                  out_ready,
    output logic        [   23:0] out_color,        // sRGB bytes, red in the low byte
    output logic        [    1:0] out_hit,          // as taken
    output logic        [TAG-1:0] out_tag           // as taken
);
  localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int STAGES = 12;

  // What goes along: valid, outcome and tag.
  logic [STAGES:1] valid;
  logic [TAG+1:0] along[1:STAGES];
  logic take;

  assign take = in_valid && in_ready;

  always_ff @(posedge clock) begin
    if (reset) valid <= '0;
    else valid <= {valid[STAGES-1:1], take};
    along[1] <= {in_hit, in_tag};
    for (int at = 2; at <= STAGES; at++) along[at] <= along[at-1];
  end

  // The parts.
  logic [F:0] shade;
  logic [3*(F+9)-1:0] albedo;
  logic [3*(2*F+11)-1:0] lit_color;
  logic [23:0] color;

  light #(
      .WIDE(WIDE),
      .RSQRT_LOG2(RSQRT_LOG2)
  ) light (
      .clock(clock),
      .lit(lit),
      .toward_x(toward_x),
      .toward_y(toward_y),
      .toward_z(toward_z),
      .ambient(ambient),
      .load(load_rsqrt),
      .load_address(load_address),
      .load_data(load_data),
      .slope_x(in_slope_x),
      .slope_z(in_slope_z),
      .shade(shade)
  );
  ramp #(
      .WIDE(WIDE),
      .SEGMENTS(SEGMENTS)
  ) ramp (
      .clock(clock),
      .ramp_exponent(ramp_exponent),
      .ramp_gain(ramp_gain),
      .ramp_last(ramp_last),
      .load(load_ramp),
      .load_address(load_address),
      .load_data(load_data),
      .surface(in_surface),
      .albedo(albedo)
  );
  mixer #(
      .WIDE(WIDE)
  ) mixer (
      .clock(clock),
      .albedo(albedo),
      .shade(shade),
      .lit(lit_color)
  );
  pixel #(
      .WIDE(WIDE)
  ) pixel (
      .sky_color(sky_color),
      .out_of_range_color(out_of_range_color),
      .side_color(side_color),
      .hit(along[STAGES][TAG+:2]),
      .lit(lit_color),
      .color(color)
  );

  queue #(
      .WIDTH(26 + TAG),
      .DEPTH(STAGES + 2)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(valid[STAGES]),
      .in_item({color, along[STAGES]}),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_item({out_color, out_hit, out_tag})
  );

  credit #(
      .COUNT(4)
  ) items (
      .clock(clock),
      .reset(reset),
      .depth(4'(terraline_pkg::SHADER_DEPTH)),
      .enter(take),
      .leave(out_valid && out_ready),
      .room(in_ready)
  );
endmodule
