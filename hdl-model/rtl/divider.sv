// The ratio unit: where the ray meets a plane, ground = eye + floor(view * 2^shift / denominator)
// (equations 9 and 10; thesis 2.39), for both axes.
//
// The numerator is shifted, and biased by denominator * 2^(bits-1) so that quotients are unsigned
// and the range check is one comparison. SERIAL = 0: a pipelined array, one item per cycle, an item
// taken in cycle t goes on in cycle t + bits + 3. SERIAL = 1: one stage for all bits, the next item
// is taken after bits + 3 cycles.
//
// Never divides by zero or by a negative number, never wraps a quotient: one that does not fit
// is out of range.
module divider #(
    parameter int WIDE = 0,    // words of 64 bits, not 32
    parameter int SERIAL = 0,  // one stage for all quotient bits
    parameter int SIDE = 1     // bits that go along with an item
) (
    input  logic                                    clock,
    input  logic                                    reset,           // forgets all items
    // Coefficients
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_x,           // foot of the ratio, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_z,           // the same, z
    input  logic signed [                      7:0] ratio_shift,     // numerators times 2^ratio_shift
    input  logic        [                      5:0] ratio_bits,      // quotient bits: more than POINT, at most STAGES
    // Items from the projector
    input  logic                                    in_valid,        // an item is there
    output logic                                    in_ready,        // it is taken at this edge
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_x,       // numerator, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_z,       // numerator, z
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_denominator,  // positive towards the plane
    input  logic        [                 SIDE-1:0] in_side,         // goes along
    // Items to the next unit
    output logic                                    out_valid,       // an item is there
    input  logic                                    out_ready,       // it is taken at this edge
    output logic        [                      1:0] out_entry,       // 0 met, 1 sky, 2 out of range
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_x,    // the point, valid where met
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_z,    // the same, z
    output logic        [                 SIDE-1:0] out_side         // came along
);
  localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int POINT = WIDE == 1 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  // Quotients of the largest range that the plan uses: 2^11 cells in narrow words, 2^24 in wide.
  localparam int STAGES = POINT + 1 + (WIDE == 1 ? 24 : 11);
  localparam int DEPTH = SERIAL == 1 ? terraline_pkg::STEPPER_DEPTH
                                     : STAGES + terraline_pkg::DIVIDER_ENDS + 1;
  // Set-up shifts by at most W + bits - 2: further numerators are out of range.
  localparam int ALIGNED = 2 * W + STAGES - 2;
  localparam int MET = 0, SKY = 1, OUT_OF_RANGE = 2;

  logic enter, leave, room;
  logic done;
  logic [1:0] done_entry;
  logic signed [W-1:0] quotient_x, quotient_z;

  // From a coefficient alone, in a register.
  logic [5:0] depth;
  always_ff @(posedge clock) begin
    depth <= SERIAL == 1 ? 6'(DEPTH) : ratio_bits + 6'(terraline_pkg::DIVIDER_ENDS + 1);
  end

  assign enter = in_valid && in_ready;
  assign leave = out_valid && out_ready;

  credit #(
      .COUNT(6)
  ) credits (
      .clock(clock),
      .reset(reset),
      .depth(depth),
      .enter(enter),
      .leave(leave),
      .room(room)
  );

  // First stage: the numerators are aligned to STAGES quotient bits, whatever the number in use. The
  // places depend on coefficients alone and stand in registers.
  localparam int LEFT = ALIGNED - W;
  logic signed [8:0] shift, to_right;
  logic [7:0] places;
  logic signed [ALIGNED-1:0] aligned_x, aligned_z;
  logic signed [W-1:0] denominator;
  logic checking;

  assign shift = 9'(ratio_shift) + 9'(STAGES) - $signed({3'b0, ratio_bits});

  assign to_right = 9'(LEFT) - shift;

  always_ff @(posedge clock) begin
    places <= to_right < 0 ? '0 : to_right[7:0];
    checking <= enter && !reset;
    if (enter) begin
      aligned_x <= $signed({in_view_x, {LEFT{1'b0}}}) >>> places;
      aligned_z <= $signed({in_view_z, {LEFT{1'b0}}}) >>> places;
      denominator <= in_denominator;
    end
  end

  // Second stage: bias and range check. In range are numerators in [-bias, bias), of which the biased
  // ones lie in [0, denominator * 2^STAGES); numerators that need more than LOW bits are not.
  localparam int LOW = W + STAGES - 1;
  logic signed [LOW:0] bias, biased_x, biased_z, beyond_x, beyond_z;
  logic signed [ALIGNED-LOW:0] above_x, above_z;
  logic sky, out_x, out_z;
  logic [1:0] entry;

  assign bias = (LOW + 1)'(denominator) <<< (STAGES - 1);
  assign biased_x = $signed(aligned_x[LOW:0]) + bias;
  assign biased_z = $signed(aligned_z[LOW:0]) + bias;
  assign beyond_x = $signed(aligned_x[LOW:0]) - bias;
  assign beyond_z = $signed(aligned_z[LOW:0]) - bias;
  assign above_x = aligned_x[ALIGNED-1:LOW-1];
  assign above_z = aligned_z[ALIGNED-1:LOW-1];
  assign sky = denominator <= 0;
  assign out_x = (above_x != '0 && above_x != '1) || biased_x < 0 || beyond_x >= 0;
  assign out_z = (above_z != '0 && above_z != '1) || biased_z < 0 || beyond_z >= 0;
  assign entry = sky ? 2'(SKY) : out_x || out_z ? 2'(OUT_OF_RANGE) : 2'(MET);

  if (SERIAL == 0) begin : pipelined
    divider_array #(
        .W(W),
        .STAGES(STAGES),
        .FIRST(POINT + 1)
    ) stages (
        .clock(clock),
        .reset(reset),
        .bits(ratio_bits),
        .in_valid(checking),
        .in_entry(entry),
        .in_denominator(denominator),
        .in_remainder_x({1'b0, biased_x[LOW:STAGES]}),
        .in_remainder_z({1'b0, biased_z[LOW:STAGES]}),
        .in_digits_x(biased_x[STAGES-1:0]),
        .in_digits_z(biased_z[STAGES-1:0]),
        .out_valid(done),
        .out_entry(done_entry),
        .out_quotient_x(quotient_x),
        .out_quotient_z(quotient_z)
    );
    assign in_ready = room;
  end else begin : serial
    logic busy;
    divider_serial #(
        .W(W),
        .STAGES(STAGES)
    ) stages (
        .clock(clock),
        .reset(reset),
        .bits(ratio_bits),
        .in_valid(checking),
        .in_entry(entry),
        .in_denominator(denominator),
        .in_remainder_x({1'b0, biased_x[LOW:STAGES]}),
        .in_remainder_z({1'b0, biased_z[LOW:STAGES]}),
        .in_digits_x(biased_x[STAGES-1:0]),
        .in_digits_z(biased_z[STAGES-1:0]),
        .busy(busy),
        .out_valid(done),
        .out_entry(done_entry),
        .out_quotient_x(quotient_x),
        .out_quotient_z(quotient_z)
    );
    assign in_ready = room && !busy && !checking;
  end

  queue #(
      .WIDTH(2 + 2 * W),
      .DEPTH(DEPTH)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(done),
      .in_item({done_entry, eye_x + quotient_x, eye_z + quotient_z}),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_item({out_entry, out_ground_x, out_ground_z})
  );

  // What goes along leaves in the same order.
  logic side_valid;
  queue #(
      .WIDTH(SIDE),
      .DEPTH(DEPTH)
  ) sides (
      .clock(clock),
      .reset(reset),
      .put(enter),
      .in_item(in_side),
      .out_valid(side_valid),
      .out_ready(leave),
      .out_item(out_side)
  );
endmodule
