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
  // The oldest item stands in a register, so that the next unit begins its cycle with it; the others
  // wait in a memory, and one that finds nobody before it passes by.
  localparam int ROOM = DEPTH > 2 ? DEPTH - 1 : 1;
  localparam int INDEX = ROOM > 1 ? $clog2(ROOM) : 1;
  localparam int COUNT = $clog2(ROOM + 1);
  localparam logic [INDEX-1:0] LAST = INDEX'(ROOM - 1);
  localparam logic [COUNT-1:0] FULL = COUNT'(ROOM);

  logic [WIDTH-1:0] items[ROOM];
  logic [INDEX-1:0] head, tail;
  logic [COUNT-1:0] waiting;  // items in the memory
  logic free, fetch, pass, store;

  assign free = !out_valid || out_ready;  // the register, at this edge
  assign fetch = free && waiting != '0;
  assign pass = put && free && waiting == '0;
  assign store = put && !pass;

  always_ff @(posedge clock) begin
    // Where there is a place behind the others, it may be written in any cycle: `put` often comes late.
    if (waiting != FULL) items[tail] <= in_item;
    if (free) out_item <= fetch ? items[head] : in_item;
    if (reset) begin
      out_valid <= 1'b0;
      head <= '0;
      tail <= '0;
      waiting <= '0;
    end else begin
      out_valid <= !free || fetch || pass;
      if (store) tail <= tail == LAST ? '0 : tail + INDEX'(1);
      if (fetch) head <= head == LAST ? '0 : head + INDEX'(1);
      if (store && !fetch) waiting <= waiting + COUNT'(1);
      if (!store && fetch) waiting <= waiting - COUNT'(1);
    end
  end
endmodule
