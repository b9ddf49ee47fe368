// Counts the items that a unit holds, in its pipeline and its queue, and says when one more fits:
// D of equation 28. A place that an item leaves at one edge is free from the next cycle on.
module credit #(
    parameter int COUNT = 2  // bits of the count
) (
    input  logic             clock,
    input  logic             reset,  // none is held
    input  logic [COUNT-1:0] depth,  // D: most items
    input  logic             enter,  // an item enters at this edge
    input  logic             leave,  // an item leaves at this edge
    output logic             room    // one more fits
);
  logic [COUNT-1:0] held;

  assign room = held != depth;

  always_ff @(posedge clock) begin
    if (reset) held <= '0;
    else if (enter && !leave) held <= held + COUNT'(1);
    else if (!enter && leave) held <= held - COUNT'(1);
  end
endmodule
