// The kernel ROM: tables of a finite function's weight and of its derivative (equations 12, 13 and
// 17 of docs/mathematics.md; thesis 2.42 to 2.46, 2.63), read at the entry nearest to an argument
// of either axis.
//
// entry = floor(s·2^t + ½), or 2^t − entry where it is mirrored. The words are there one cycle
// after the argument. Never floored. A weight is taken to lie in [0, 1] and a slope in (−4, 4):
// what is loaded is cut to POINT + 1 and POINT + 3 bits.
module kernel_rom #(
    parameter int WIDE       = 0,   // 0: 32-bit words, 1: 64-bit words
    parameter int TABLE_LOG2 = 12,  // largest t: the tables have room for 2^TABLE_LOG2 + 1 entries
    parameter int SLOPES     = 1    // 1: the derivative's table is fitted
) (
    input  logic                             clock,
    input  logic [                      4:0] table_log2,    // t, from 1 to TABLE_LOG2
    input  logic                             load_weight,   // put load_data into the weights
    input  logic                             load_slope,    // put load_data into the slopes
    input  logic [                     16:0] load_address,  // entry, from 0 to 2^t
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] load_data,     // a word of the weight's format
    input  logic [(WIDE != 0 ? 24 : 20)-1:0] argument_x,    // s in [0, 1), a position's fraction
    input  logic [(WIDE != 0 ? 24 : 20)-1:0] argument_z,
    input  logic                             mirrored_x,    // read the entry of 1 − s
    input  logic                             mirrored_z,
    output logic [    WIDE != 0 ? 24 : 20:0] weight_x,      // in [0, 1], one cycle later
    output logic [    WIDE != 0 ? 24 : 20:0] weight_z,
    output logic [    WIDE != 0 ? 26 : 22:0] slope_x,       // signed, one cycle later
    output logic [    WIDE != 0 ? 26 : 22:0] slope_z        // zero where SLOPES is 0
);
  localparam int POINT = WIDE != 0 ? 24 : 20;
  logic [TABLE_LOG2:0] entry_x, entry_z;

  // The entry nearest to an argument: the bit below the last one rounds.
  function automatic logic [TABLE_LOG2:0] nearest(input logic [POINT-1:0] argument,
                                                  input logic [4:0] log2);
    logic [TABLE_LOG2:0] twice;
    twice = (TABLE_LOG2 + 1)'(argument >> (5'(POINT - 1) - log2));
    nearest = (twice >> 1) + {{TABLE_LOG2{1'b0}}, twice[0]};
  endfunction

  function automatic logic [TABLE_LOG2:0] mirror(input logic [TABLE_LOG2:0] direct,
                                                 input logic [4:0] log2, input logic mirrored);
    mirror = mirrored ? ((TABLE_LOG2 + 1)'(1) << log2) - direct : direct;
  endfunction

  assign entry_x = mirror(nearest(argument_x, table_log2), table_log2, mirrored_x);
  assign entry_z = mirror(nearest(argument_z, table_log2), table_log2, mirrored_z);

  kernel_table #(
      .WIDTH(POINT + 1),
      .TABLE_LOG2(TABLE_LOG2)
  ) weights (
      .clock(clock),
      .load(load_weight),
      .load_address(load_address),
      .load_data((POINT + 1)'(load_data)),
      .entry_x(entry_x),
      .entry_z(entry_z),
      .word_x(weight_x),
      .word_z(weight_z)
  );

  generate
    if (SLOPES != 0) begin : gen_slopes
      kernel_table #(
          .WIDTH(POINT + 3),
          .TABLE_LOG2(TABLE_LOG2)
      ) slopes (
          .clock(clock),
          .load(load_slope),
          .load_address(load_address),
          .load_data((POINT + 3)'(load_data)),
          .entry_x(entry_x),
          .entry_z(entry_z),
          .word_x(slope_x),
          .word_z(slope_z)
      );
    end else begin : gen_no_slopes
      assign slope_x = '0;
      assign slope_z = '0;
    end
  endgenerate
endmodule
