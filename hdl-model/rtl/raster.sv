// The raster scan: counts the pixels of a frame, column by column, line by line.
//
// `start` is given once coefficients, tables and maps are loaded; the cycle after it is cycle 0.
module raster (
    input  logic        clock,
    input  logic        reset,        // no frame is drawn
    input  logic        start,        // a frame begins in the next cycle
    input  logic [15:0] columns,      // pixels across, at least one
    input  logic [15:0] lines,        // scan lines, at least one
    input  logic        step,         // the pixel is taken at this edge
    output logic        running,      // there is a pixel to be taken
    output logic        last_column   // it is the last of its line
);
  logic [15:0] column, line;
  logic last_line;

  assign last_column = column == columns - 16'd1;
  assign last_line   = line == lines - 16'd1;

  always_ff @(posedge clock) begin
    if (reset) running <= 1'b0;
    else if (start) running <= 1'b1;
    else if (step && last_column && last_line) running <= 1'b0;

    if (start) begin
      column <= '0;
      line   <= '0;
    end else if (step) begin
      column <= last_column ? '0 : column + 16'd1;
      if (last_column) line <= line + 16'd1;
    end
  end
endmodule
