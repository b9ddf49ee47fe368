// The pipelined divider behind its range check: one register stage per quotient bit, for both axes.
//
// The numerator's low bits and the quotient share a shift register: each stage takes its bit from
// the top and puts its quotient bit in at the bottom. An item that comes in in cycle c is at
// `out_valid` in cycle c + 1 + bits. Never stalls.
module divider_array #(
    parameter int W = 32,       // bits of the denominator
    parameter int STAGES = 32,  // most quotient bits
    parameter int FIRST = 21    // least quotient bits
) (
    input  logic                     clock,
    input  logic                     reset,           // forgets all items
    input  logic        [       5:0] bits,            // quotient bits in use, FIRST to STAGES
    input  logic                     in_valid,        // an item comes in
    input  logic        [       1:0] in_entry,        // goes along
    input  logic signed [     W-1:0] in_denominator,  // positive
    input  logic signed [       W:0] in_remainder_x,  // numerator's high bits, in [0, denominator)
    input  logic signed [       W:0] in_remainder_z,  // the same, z
    input  logic        [STAGES-1:0] in_digits_x,     // numerator's low bits
    input  logic        [STAGES-1:0] in_digits_z,     // the same, z
    output logic                     out_valid,       // an item is done
    output logic        [       1:0] out_entry,       // came along
    output logic signed [     W-1:0] out_quotient_x,  // without its bias
    output logic signed [     W-1:0] out_quotient_z   // the same, z
);
  // One entry per stage, and one behind the last.
  logic [STAGES:0] valid;
  logic [(STAGES+1)*2-1:0] entries;
  logic [STAGES*W-1:0] denominators;
  logic [(STAGES+1)*(W+1)-1:0] remainders_x, remainders_z;
  logic [(STAGES+1)*STAGES-1:0] digits_x, digits_z;
  logic [STAGES*(W+1)-1:0] next_x, next_z;
  logic [STAGES-1:0] quotient_bits_x, quotient_bits_z;

  for (genvar s = 0; s < STAGES; s++) begin : stage
    divider_stage #(
        .W(W)
    ) stage_x (
        .remainder(remainders_x[s*(W+1)+:W+1]),
        .denominator(denominators[s*W+:W]),
        .numerator_bit(digits_x[(s+1)*STAGES-1]),
        .next(next_x[s*(W+1)+:W+1]),
        .quotient_bit(quotient_bits_x[s])
    );
    divider_stage #(
        .W(W)
    ) stage_z (
        .remainder(remainders_z[s*(W+1)+:W+1]),
        .denominator(denominators[s*W+:W]),
        .numerator_bit(digits_z[(s+1)*STAGES-1]),
        .next(next_z[s*(W+1)+:W+1]),
        .quotient_bit(quotient_bits_z[s])
    );
  end

  always_ff @(posedge clock) begin
    if (reset) valid <= '0;
    else valid <= {valid[STAGES-1:0], in_valid};
    entries <= {entries[STAGES*2-1:0], in_entry};
    denominators <= {denominators[(STAGES-1)*W-1:0], in_denominator};
    remainders_x <= {next_x, in_remainder_x};
    remainders_z <= {next_z, in_remainder_z};
    digits_x[STAGES-1:0] <= in_digits_x;
    digits_z[STAGES-1:0] <= in_digits_z;
    for (int s = 0; s < STAGES; s++) begin
      digits_x[(s+1)*STAGES+:STAGES] <= {digits_x[s*STAGES+:STAGES-1], quotient_bits_x[s]};
      digits_z[(s+1)*STAGES+:STAGES] <= {digits_z[s*STAGES+:STAGES-1], quotient_bits_z[s]};
    end
  end

  // Behind the stages in use. The quotient's bias 2^(bits-1) is taken off by inverting its top bit,
  // which is then the sign.
  always_comb begin
    out_valid = 1'b0;
    out_entry = '0;
    out_quotient_x = '0;
    out_quotient_z = '0;
    for (int s = FIRST; s <= STAGES; s++) begin
      if (bits == 6'(s)) begin
        out_valid = valid[s];
        out_entry = entries[s*2+:2];
        for (int b = 0; b < W; b++) begin
          out_quotient_x[b] = b < s - 1 ? digits_x[s*STAGES+b] : !digits_x[s*STAGES+s-1];
          out_quotient_z[b] = b < s - 1 ? digits_z[s*STAGES+b] : !digits_z[s*STAGES+s-1];
        end
      end
    end
  end
endmodule
