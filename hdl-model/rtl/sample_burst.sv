// Samples on their way to the interpolation and back: bursts between two skip tests, which stream; the
// middle of each bisection step, one at a time; and on maps with holes the two places beside a hit.
//
// `issue` runs ahead of the answers, `follow` and `place` come behind with them. What was issued behind a
// sample whose answer ends the work is of no interest any more: it belongs to another epoch. A sample's
// first cycle follows the last one of the sample before.
module sample_burst #(
    parameter int W = 32  // bits of a word
) (
    input  logic                clock,
    input  logic                reset,           // no sample is on its way
    // What the stepper does in this cycle
    input  logic                plans,           // starts a walk, or waits for a bound: a burst may follow
    input  logic                streams,         // a burst streams
    input  logic                halves,          // asks for the middle of a bisection step
    input  logic                rims,            // asks for the places beside the hit
    input  logic                ends,            // has the last answer that it wants
    // The walk
    input  logic        [  6:0] run,             // samples of the burst that may follow
    input  logic signed [W-1:0] issue_x,         // next sample of a burst, x
    input  logic signed [W-1:0] issue_z,         // z
    input  logic                issue_over,      // nothing can be met from there on
    input  logic signed [W-1:0] place_x,         // clear place, x
    input  logic signed [W-1:0] place_z,         // z
    input  logic signed [W-1:0] follow_x,        // place whose answer comes next, x
    input  logic signed [W-1:0] follow_y,        // its height
    input  logic signed [W-1:0] follow_z,        // z
    // Samples to the interpolation, and its answers
    output logic                sample_valid,    // a sample is there
    output logic                sample_first,    // in its first cycle
    output logic signed [W-1:0] sample_x,        // place, x
    output logic signed [W-1:0] sample_z,        // z
    output logic        [  2:0] sample_tag,      // goes along: epoch, last of its burst, over
    input  logic                sample_last,     // in its last cycle
    input  logic                answer_valid,    // an answer is there
    input  logic                answer_exists,   // there is a surface at the place
    input  logic signed [W-1:0] answer_surface,  // its height
    input  logic        [  2:0] answer_tag,      // came along
    // To the stepper
    output logic                issues,          // `issue` is read for the last time
    output logic                answered,        // an answer of this epoch is there
    output logic                hits,            // `follow` is under the surface
    output logic                tag_last,        // it was the last sample of its burst
    output logic                tag_over,        // nothing can be met from there on
    output logic                rim_answered,    // one place beside the hit has been answered
    output logic                clear_exists,    // there is a surface at the clear place
    output logic                middle_exists,   // and at the hit
    output logic        [  6:0] to_issue         // samples of the burst, for the proofs
);
  logic epoch;
  logic sampling;  // a sample is in its later cycles
  logic issued;  // a middle is on its way; at the rim: the first place
  logic issued_second;

  assign sample_valid = streams ? to_issue != '0 : halves ? !issued : rims && !issued_second;
  assign sample_first = !sampling;
  assign sample_tag = {epoch, to_issue == 7'd1, issue_over};
  always_comb begin
    if (streams) begin
      sample_x = issue_x;
      sample_z = issue_z;
    end else if (rims && !issued) begin
      sample_x = place_x;
      sample_z = place_z;
    end else begin
      sample_x = follow_x;
      sample_z = follow_z;
    end
  end
  assign issues = streams && sample_valid && sample_last;

  assign answered = answer_valid && answer_tag[2] == epoch;
  assign tag_last = answer_tag[1];
  assign tag_over = answer_tag[0];
  assign hits = answer_exists && follow_y < answer_surface;

  always_ff @(posedge clock) begin
    if (reset) begin
      epoch <= 1'b0;
      sampling <= 1'b0;
    end else begin
      if (ends) epoch <= !epoch;
      sampling <= sample_valid && !sample_last && !ends;
    end
    if (plans || (streams && answered && tag_last)) to_issue <= run;
    else if (issues) to_issue <= to_issue - 7'd1;
    if (halves && !answered) begin
      if (sample_valid && sample_last) issued <= 1'b1;
    end else if (rims) begin
      if (sample_valid && sample_last) begin
        issued <= 1'b1;
        issued_second <= issued;
      end
      if (answered) begin
        rim_answered <= 1'b1;
        if (rim_answered) middle_exists <= answer_exists;
        else clear_exists <= answer_exists;
      end
    end else begin
      issued <= 1'b0;
      issued_second <= 1'b0;
      rim_answered <= 1'b0;
    end
  end
endmodule
