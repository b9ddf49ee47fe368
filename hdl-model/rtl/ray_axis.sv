// One axis of a ray's walk: three accumulators and the place ahead (equations 19, 21 and 22;
// thesis 2.1).
//
// `place` is the last place known to be clear. `follow` is the one whose answer comes next: a step further
// than `place`, or while a hit is halved the middle between `place` and it. `issue` is the next sample of a
// burst that streams through the interpolation. What decides late in a cycle (`moves`, `hits`) chooses
// between sums that are made beside it.
//
// Never wraps a position (the plan proves their range), never multiplies.
module ray_axis #(
    parameter int W = 32  // bits of a word
) (
    input  logic                clock,
    input  logic signed [W-1:0] step,       // of the ray
    input  logic signed [W-1:0] origin,     // where the ray enters
    input  logic        [  5:0] jump_log2,  // steps of a jump, as a power of two
    // What the stepper does in this cycle
    input  logic                takes,      // takes a ray: go to the origin
    input  logic                starts,     // starts the walk with the step
    input  logic                tries,      // tries a jump
    input  logic                waits,      // waits for its bound
    input  logic                issues,     // the sample `issue` is read for the last time
    input  logic                aims,       // begins to halve
    input  logic                halves,     // halves
    input  logic                answered,   // `follow` is answered: a sample, a middle
    input  logic                hits,       // and it hits
    input  logic                moves,      // the jump is made, or the answer is no hit
    // Places
    output logic signed [W-1:0] place,      // clear
    output logic signed [W-1:0] follow,     // answered next
    output logic signed [W-1:0] issue,      // read next
    output logic signed [W-1:0] ahead,      // at the end of the jump that is tried
    output logic signed [W-1:0] met         // the last hit
);
  logic signed [W-1:0] half, half_step, stay, lead, go;

  // Half of the step, and then half of the half step.
  assign half_step = (aims ? step : half) >>> 1;
  assign stay = place + (starts ? step : half_step);
  assign lead = waits ? ahead : follow;
  assign go = lead + (halves ? half_step : step);

  always_ff @(posedge clock) begin
    if (takes) place <= origin;
    else if (moves) place <= lead;
    if (tries) ahead <= place + (step <<< jump_log2);
    if (answered && hits) met <= follow;
    if (aims || (halves && answered)) half <= half_step;
    if (starts || aims || (halves && answered && hits)) follow <= stay;
    else if (moves) follow <= go;
    if (starts) issue <= stay;
    else if (waits) issue <= moves ? go : follow;
    else if (issues) issue <= issue + step;
  end
endmodule
