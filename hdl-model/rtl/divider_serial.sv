// The serial divider behind its range check: one stage per axis, a quotient bit per cycle.
//
// An item that comes in in cycle c is at `out_valid` in cycle c + 1 + bits, for that cycle only. The
// next one may come in behind it.
module divider_serial #(
    parameter int W = 32,      // bits of the denominator
    parameter int STAGES = 32  // most quotient bits
) (
    input  logic                     clock,
    input  logic                     reset,           // forgets the item
    input  logic        [       5:0] bits,            // quotient bits in use, at most STAGES
    input  logic                     in_valid,        // an item comes in
    input  logic        [       1:0] in_entry,        // goes along
    input  logic signed [     W-1:0] in_denominator,  // positive
    input  logic signed [       W:0] in_remainder_x,  // numerator's high bits, in [0, denominator)
    input  logic signed [       W:0] in_remainder_z,  // the same, z
    input  logic        [STAGES-1:0] in_digits_x,     // numerator's low bits
    input  logic        [STAGES-1:0] in_digits_z,     // the same, z
    output logic                     busy,            // an item is in work, or done in this cycle
    output logic                     out_valid,       // it is done
    output logic        [       1:0] out_entry,       // came along
    output logic signed [     W-1:0] out_quotient_x,  // without its bias
    output logic signed [     W-1:0] out_quotient_z   // the same, z
);
  logic [5:0] left;  // bits to come
  logic signed [W-1:0] denominator;
  logic signed [W:0] remainder_x, remainder_z, next_x, next_z;
  logic [STAGES-1:0] digits_x, digits_z;
  logic first;  // the next bit is a quotient's first one
  logic bit_x, bit_z;

  divider_stage #(
      .W(W)
  ) stage_x (
      .remainder(remainder_x),
      .denominator(denominator),
      .numerator_bit(digits_x[STAGES-1]),
      .next(next_x),
      .quotient_bit(bit_x)
  );
  divider_stage #(
      .W(W)
  ) stage_z (
      .remainder(remainder_z),
      .denominator(denominator),
      .numerator_bit(digits_z[STAGES-1]),
      .next(next_z),
      .quotient_bit(bit_z)
  );

  assign out_valid = busy && left == '0;

  always_ff @(posedge clock) begin
    if (reset) busy <= 1'b0;
    else if (in_valid) busy <= 1'b1;
    else if (out_valid) busy <= 1'b0;
    if (in_valid) begin
      left <= bits;
      first <= 1'b1;
      denominator <= in_denominator;
      remainder_x <= in_remainder_x;
      remainder_z <= in_remainder_z;
      digits_x <= in_digits_x;
      digits_z <= in_digits_z;
      out_entry <= in_entry;
    end else if (left != '0) begin
      left <= left - 6'd1;
      first <= 1'b0;
      remainder_x <= next_x;
      remainder_z <= next_z;
      digits_x <= {digits_x[STAGES-2:0], 1'b0};
      digits_z <= {digits_z[STAGES-2:0], 1'b0};
      // The quotient's bias 2^(bits-1) is taken off by inverting its first bit, which is then the sign.
      out_quotient_x <= first ? {W{!bit_x}} : {out_quotient_x[W-2:0], bit_x};
      out_quotient_z <= first ? {W{!bit_z}} : {out_quotient_z[W-2:0], bit_z};
    end
  end
endmodule
