// A queue between two units: what is put in at one clock edge can be taken from the next cycle on.
//
// Its owner never puts in more than DEPTH items; `held` units count their items (see
// docs/cycles.md), so the queue itself needs no "full".
module queue #(
    parameter int WIDTH = 8,  // bits of an item
    parameter int DEPTH = 2   // most items
) (
    input  logic             clock,
    input  logic             reset,      // empties it
    input  logic             put,        // take `in_item` at this edge
    input  logic [WIDTH-1:0] in_item,
    output logic             out_valid,  // an item is there
    input  logic             out_ready,  // the next unit takes it at this edge
    output logic [WIDTH-1:0] out_item    // the oldest item
);
  localparam int INDEX = DEPTH > 1 ? $clog2(DEPTH) : 1;
  localparam int COUNT = $clog2(DEPTH + 1);
  localparam logic [INDEX-1:0] LAST = INDEX'(DEPTH - 1);

  logic [WIDTH-1:0] items[DEPTH];
  logic [INDEX-1:0] head, tail;
  logic [COUNT-1:0] count;
  logic             take;

  assign out_valid = count != '0;
  assign out_item  = items[head];
  assign take      = out_valid && out_ready;

  always_ff @(posedge clock) begin
    if (put) items[tail] <= in_item;
    if (reset) begin
      head  <= '0;
      tail  <= '0;
      count <= '0;
    end else begin
      if (put) tail <= tail == LAST ? '0 : tail + INDEX'(1);
      if (take) head <= head == LAST ? '0 : head + INDEX'(1);
      if (put && !take) count <= count + COUNT'(1);
      if (!put && take) count <= count - COUNT'(1);
    end
  end
endmodule
