// A quantity that is linear in the screen, by one addition per pixel and one per line (equations 5
// and 6; thesis 2.36, 2.37): a register for the pixel, and one for the first column of its line.
//
// Never multiplies, rounds or saturates.
module accumulator #(
    parameter int W = 32  // bits of a word
) (
    input  logic                clock,
    input  logic                start,        // go to line 0, column 0
    input  logic                step,         // go to the next pixel
    input  logic                last_column,  // which is the first of the next line
    input  logic signed [W-1:0] first,        // value at line 0, column 0
    input  logic signed [W-1:0] per_line,     // increment per line
    input  logic signed [W-1:0] per_column,   // increment per column
    output logic signed [W-1:0] value         // value of the pixel
);
  logic signed [W-1:0] line_start, next_line;

  assign next_line = line_start + per_line;

  always_ff @(posedge clock) begin
    if (start) begin
      value <= first;
      line_start <= first;
    end else if (step) begin
      value <= last_column ? next_line : value + per_column;
      if (last_column) line_start <= next_line;
    end
  end
endmodule
