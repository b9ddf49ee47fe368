// The ramp: the colour of the ground by its height, before it is lit (equation 26 of
// docs/mathematics.md).
//
// The height's place on the ramp chooses a segment of a table and mixes the colours at its ends.
//
// Cycles: a surface of cycle t has its albedo in cycle t + 11; one pixel per cycle. The stages, by
// the register that ends them:
//
// 1 | the height
// 2 | shifted by the ramp's exponent
// 3 | rounded
// 4 | height x gain: sums of rows
// 5 | place on the ramp
// 6 | before the ramp, beyond it
// 7 | segment and fraction
// 8 | colours of the segment, read
// 9 | rise x fraction: sums of rows
// 10| their sum
// 11| start added
//
// Ranges, with F = POINT; every multiplier and table is as wide as these ask for:
// - height on its way to the ramp: in [-2, 2), F + 2 bits. By (26) it is in [0, 1] over 2x2 nodes, and
//   at most 1.24 over 3x3, whose weights sum to at most 1.111 per axis. Heights of pixels that meet no
//   surface are arbitrary.
// - gain <= 30 by (26) with up to 15 segments, F + 6 bits with sign; place in [-60, 60].
// - ramp colours are bytes: start 0 .. 255, rise -255 .. 255, start + rise 0 .. 255, no fraction
//   bits. The product with the fraction is exact; the channel is in [0, 255], F + 8 bits.
//
// Never divides; table and coefficients do not change while pixels are in it.
module ramp #(
    parameter int WIDE = 0,  // 0: words of 32 bits, 1: of 64
    parameter int SEGMENTS = 15,  // most segments of the ramp, up to 15
    localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT
) (
    input logic clock,

    // Coefficients.
    input logic signed [  7:0] ramp_exponent,  // power of two on heights; beyond 8 bits, its limit
    input logic signed [W-1:0] ramp_gain,      // segments per shifted height
    input logic        [  3:0] ramp_last,      // segments minus one

    // Table.
    input logic         load,          // write `load_data` to the ramp
    input logic [ 15:0] load_address,  // segment*8 + channel*2 + (0 start, 1 rise)
    input logic [W-1:0] load_data,     // tone word

    // Pixels.
    input  logic signed [      W-1:0] surface,  // height above the lowest node
    output logic        [3*(F+9)-1:0] albedo    // channels, signed, red lowest, 11 cycles later
);
  localparam logic [F-1:0] HALF = F'(1) << (F - 1);
  localparam logic [F:0] ONE = (F + 1)'(1) << F;

  // 1 to 3: the height shifted by the ramp's exponent, and rounded.
  localparam int LEFT = F + 1;  // a shift to the left by more leaves no bit of a height in range

  logic signed [W-1:0] surface_1;
  logic [F+2:0] height, height_2;
  logic signed [F+1:0] height_3;
  logic signed [8:0] places;
  logic [7:0] height_places;  // of coefficients alone, in a register

  assign places = 9'(LEFT) - 9'(ramp_exponent);

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .LEFT(LEFT),
      .PLACES(8)
  ) shift_height (
      .value (surface_1),
      .places(height_places),
      .out   (height)
  );

  always_ff @(posedge clock) begin
    height_places <= places < 0 ? 8'd0 : places[7:0];
    surface_1 <= surface;
    height_2  <= height;
    height_3  <= height_2[F+2:1] + (F + 2)'(height_2[0]);
  end

  // 4 and 5: the place on the ramp, in segments.
  logic signed [2*F+7:0] place;
  logic signed [2*F+7:0] place_half;
  logic signed [F+6:0] place_5;

  product #(
      .A(F + 2),
      .B(F + 6)
  ) multiply_place (
      .clock(clock),
      .a(height_3),
      .b(ramp_gain[F+5:0]),
      .result(place)
  );

  assign place_half = place + $signed({{(F + 8) {1'b0}}, HALF});

  always_ff @(posedge clock) place_5 <= place_half[2*F+6:F];

  // 6 and 7: segment, and fraction inside it. The end of the ramp is that of its last segment.
  localparam int INDEX = $clog2(SEGMENTS + 1);

  logic signed [6:0] cell_5;
  logic before_6, beyond_6;
  logic [INDEX-1:0] cell_6, segment_7;
  logic [F-1:0] inside_6;
  logic [F:0] fraction_7, fraction_8;

  assign cell_5 = place_5[F+6:F];

  always_ff @(posedge clock) begin
    before_6 <= cell_5 < 0;
    beyond_6 <= cell_5 > $signed({3'b0, ramp_last});
    cell_6 <= cell_5[INDEX-1:0];
    inside_6 <= place_5[F-1:0];
    if (before_6) segment_7 <= '0;
    else segment_7 <= beyond_6 ? ramp_last[INDEX-1:0] : cell_6;
    fraction_7 <= beyond_6 ? ONE : {1'b0, inside_6};
    fraction_8 <= fraction_7;
  end

  // 8 to 11: the colours of the segment.
  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    logic [7:0] starts[1<<INDEX];
    logic signed [8:0] rises[1<<INDEX];
    logic load_channel;
    logic [7:0] start_8, start_9, start_10;
    logic signed [8:0] rise_8;
    logic signed [F+10:0] risen;
    logic signed [F+8:0] risen_10;
    logic signed [F+8:0] color_11;

    assign load_channel = load && load_address[2:1] == 2'(channel);

    always_ff @(posedge clock) begin
      if (load_channel && !load_address[0]) starts[load_address[3+:INDEX]] <= load_data[F+:8];
      if (load_channel && load_address[0]) rises[load_address[3+:INDEX]] <= load_data[F+:9];
      start_8 <= starts[segment_7];
      rise_8 <= rises[segment_7];
      start_9 <= start_8;
      start_10 <= start_9;
      risen_10 <= risen[F+8:0];
      color_11 <= risen_10 + $signed({1'b0, start_10, {F{1'b0}}});
    end

    product #(
        .A(F + 2),
        .B(9)
    ) multiply_rise (
        .clock(clock),
        .a($signed({1'b0, fraction_8})),
        .b(rise_8),
        .result(risen)
    );

    assign albedo[(F+9)*channel+:F+9] = color_11;
  end
endmodule
