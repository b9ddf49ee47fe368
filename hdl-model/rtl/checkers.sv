// The checker: the colour of a pixel of a plane (equation 27 of docs/mathematics.md). `checker` is a
// reserved word, so the module has the plural.
//
// The parity of the square chooses between two colours, mean + swing and mean - swing; the swing is
// multiplied with the contrast, which the denominator gives. Sky and out of range have constant colours. It
// stands where height maps have the shader, with the shader's handshake and timing.
//
// Cycles: one item per cycle. An item taken in cycle t is at the output in cycle t + 13 (L = 13:
// twelve stages and the put into the queue); at most D = 14 items are held. The stages, by the
// register that ends them:
//
// 1  parity; denominator compared with that of full contrast
// 2  denominator shifted by the contrast's exponent
// 3  rounded
// 4  denominator x gain: sums of rows
// 5  their sum, rounded
// 6  minus one
// 7  limited to 0 .. 1
// 8  swing x contrast: sums of rows
// 9  their sum, rounded
// 10 mean plus or minus that
// 11 rounded to bytes
// 12 constant colours
// 13 into the queue
//
// Ranges, with F = POINT; every multiplier is as wide as these ask for:
// - denominator of an item that is met: 0 or more. Shifted by the exponent below `full_from`: in
//   [0, 2] by (27), as full contrast is where it is at least 1 (twice [1/2, 1)), and a register
//   without `full_from` does not reach that; F + 3 bits with sign. From `full_from` on it is arbitrary.
// - gain: 0, or in [1, 2]; F + 3 bits with sign. Product <= 4, F + 3 bits without sign.
// - contrast: in [0, 1], F + 2 bits with sign.
// - mean and swing are half the sum and half the difference of two bytes, whole or half levels:
//   mean 0 .. 255, swing -127.5 .. 127.5, 9 bits each; the channel is in [0, 255].
//
// Never divides, never stalls inside; coefficients do not change while items are held.
module checkers #(
    parameter int WIDE = 0,  // 0: words of 32 bits, 1: of 64
    parameter int TAG  = 1,  // bits that go along with an item
    localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input logic clock,
    input logic reset,                              // no items are held

    // Coefficients.
    input logic        [ 23:0] sky_color,           // colours, red in the low byte: nothing is met
    input logic        [ 23:0] out_of_range_color,  // out of range
    input logic signed [W-1:0] mean_red,            // mean of the two colours, tone words
    input logic signed [W-1:0] mean_green,
    input logic signed [W-1:0] mean_blue,
    input logic signed [W-1:0] swing_red,           // half their difference, tone words
    input logic signed [W-1:0] swing_green,
    input logic signed [W-1:0] swing_blue,
    input logic signed [  7:0] contrast_exponent,   // power of two on denominators; beyond 8 bits, its limit
    input logic signed [W-1:0] contrast_gain,       // contrast plus one, per shifted denominator
    input logic signed [W-1:0] full_from,           // view word: contrast is full from here on
    input logic                full_from_fitted,    // without it no pixel reaches full contrast

    // Items.
    input  logic                  in_valid,
    output logic                  in_ready,
    input  logic        [    1:0] in_entry,         // 0 met, 1 sky, 2 out of range
    input  logic signed [  W-1:0] in_ground_x,      // place in squares, ground words
    input  logic signed [  W-1:0] in_ground_z,
    input  logic signed [  W-1:0] in_denominator,   // view word
    input  logic        [TAG-1:0] in_tag,           // goes along
    output logic                  out_valid,
    input  logic                  out_ready,
    output logic        [   23:0] out_color,        // sRGB bytes, red in the low byte
    output logic        [    1:0] out_hit,          // 0 sky, 1 surface, 3 out of range
    output logic        [TAG-1:0] out_tag           // as taken
);
  localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int VIEW = WIDE != 0 ? terraline_pkg::WIDE_VIEW_POINT : terraline_pkg::NARROW_VIEW_POINT;
  localparam int STAGES = 12;
  localparam logic [F-1:0] HALF = F'(1) << (F - 1);
  localparam logic [F:0] ONE = (F + 1)'(1) << F;

  // What goes along: valid, outcome and tag.
  logic [STAGES:1] valid;
  logic [TAG+1:0] along[1:STAGES];
  logic [1:0] hit;
  logic take;

  assign take = in_valid && in_ready;

  always_comb begin
    case (in_entry)
      2'd0: hit = 2'd1;
      2'd1: hit = 2'd0;
      default: hit = 2'd3;
    endcase
  end

  always_ff @(posedge clock) begin
    if (reset) valid <= '0;
    else valid <= {valid[STAGES-1:1], take};
    along[1] <= {hit, in_tag};
    for (int at = 2; at <= STAGES; at++) along[at] <= along[at-1];
  end

  // 1: parity, and whether contrast is full.
  logic signed [W-1:0] denominator_1;
  logic [9:1] odd;
  logic [6:1] full;

  always_ff @(posedge clock) begin
    denominator_1 <= in_denominator;
    odd <= {odd[8:1], in_ground_x[F] ^ in_ground_z[F]};
    full <= {full[5:1], full_from_fitted && in_denominator >= full_from};
  end

  // 2 and 3: the denominator shifted by the contrast's exponent, and rounded.
  localparam int LEFT = F + 1;  // a shift to the left by more leaves no bit of one in range

  logic signed [8:0] places;
  logic [7:0] contrast_places;  // of coefficients alone, in a register
  logic [F+3:0] shifted, shifted_2;
  logic signed [F+2:0] scaled_3;

  // The view's binary point is left of the tone's.
  assign places = 9'(LEFT + VIEW - F) - 9'(contrast_exponent);

  rescale_shift #(
      .IN(W),
      .OUT(F + 3),
      .LEFT(LEFT),
      .PLACES(8)
  ) shift (
      .value (denominator_1),
      .places(contrast_places),
      .out   (shifted)
  );

  always_ff @(posedge clock) begin
    contrast_places <= places < 0 ? 8'd0 : places[7:0];
    shifted_2 <= shifted;
    scaled_3  <= shifted_2[F+3:1] + (F + 3)'(shifted_2[0]);
  end

  // 4 to 7: contrast.
  logic signed [2*F+5:0] raised;
  logic signed [2*F+5:0] raised_half;
  logic [F+2:0] raised_5;
  logic signed [F+3:0] less_6;
  logic [F:0] contrast_7;

  product #(
      .A(F + 3),
      .B(F + 3)
  ) multiply_gain (
      .clock(clock),
      .a(scaled_3),
      .b(contrast_gain[F+2:0]),
      .result(raised)
  );

  assign raised_half = raised + $signed({{(F + 6) {1'b0}}, HALF});

  always_ff @(posedge clock) begin
    raised_5 <= raised_half[2*F+2:F];
    less_6 <= $signed({1'b0, raised_5}) - $signed({3'b0, ONE});
    if (full[6] || less_6 > $signed({3'b0, ONE})) contrast_7 <= ONE;
    else contrast_7 <= less_6 > 0 ? less_6[F:0] : '0;
  end

  // 8 to 11: the channels.
  logic [26:0] means, swings;
  logic [23:0] color_11;

  // Half levels.
  assign means  = {mean_blue[F-1+:9], mean_green[F-1+:9], mean_red[F-1+:9]};
  assign swings = {swing_blue[F-1+:9], swing_green[F-1+:9], swing_red[F-1+:9]};

  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    logic signed [F+10:0] swung;
    logic signed [F+10:0] swung_half;
    logic signed [F+8:0] swing_9;
    logic signed [F+8:0] mean;
    logic signed [F+8:0] channel_10;
    logic signed [F+8:0] nearest;

    product #(
        .A(F + 2),
        .B(9)
    ) multiply_swing (
        .clock(clock),
        .a($signed({1'b0, contrast_7})),
        .b($signed(swings[9*channel+:9])),
        .result(swung)
    );

    // The product counts half levels: its last bit rounds.
    assign swung_half = swung + (F + 11)'(1);
    assign mean = $signed({1'b0, means[9*channel+:9], {(F - 1) {1'b0}}});
    assign nearest = channel_10 + $signed({9'b0, HALF});

    always_ff @(posedge clock) begin
      swing_9 <= swung_half[F+9:1];
      channel_10 <= odd[9] ? mean - swing_9 : mean + swing_9;
      color_11[8*channel+:8] <= nearest[F+:8];
    end
  end

  // 12: constant colours; 13: the queue.
  logic [23:0] pixel_12;
  logic [ 1:0] hit_11;

  assign hit_11 = along[11][TAG+:2];

  always_ff @(posedge clock) begin
    case (hit_11)
      2'd0: pixel_12 <= sky_color;
      2'd1: pixel_12 <= color_11;
      default: pixel_12 <= out_of_range_color;
    endcase
  end

  queue #(
      .WIDTH(26 + TAG),
      .DEPTH(STAGES + 2)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(valid[STAGES]),
      .in_item({pixel_12, along[STAGES]}),
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
