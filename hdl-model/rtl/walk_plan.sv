// What remains of a walk, and what comes next in it: a jump, of which level, or a burst of samples
// (equation 21). A jump of level m takes 2^(m + k) steps, which must not pass the last sample.
//
// The level rises by one behind a jump, unless that would pass the last sample, and falls by one where
// there was none. Walks begin at level 0, and so does what follows a burst; a skip test of level 0 that is
// not clear is followed by a burst.
module walk_plan (
    input  logic               clock,
    // Coefficients
    input  logic        [ 2:0] fineness,           // k: steps of at most 2^-k cells
    input  logic        [25:0] last,               // index of the last sample
    input  logic               skipping,           // the pyramid is fitted
    input  logic        [ 4:0] pyramid_top,        // its highest level
    // What the stepper does in this cycle
    input  logic               starts,             // starts a walk
    input  logic               tries,              // tries a jump
    input  logic               waits,              // waits for its bound
    input  logic               bounded,            // the bound is there
    input  logic               clear,              // and allows the jump
    input  logic               passes,             // a sample is answered
    input  logic               ends_burst,         // it ends its burst
    // The walk
    output logic        [25:0] remaining,          // samples up to the last one
    output logic        [25:0] remaining_next,     // behind one more sample
    output logic        [25:0] remaining_ahead,    // behind the jump that is tried
    output logic signed [ 7:0] ahead_leading,      // its leading one, where it is less than the jump
    output logic        [ 4:0] level,              // of the skip test
    output logic        [ 5:0] jump_log2,          // its steps, as a power of two
    output logic               skip_test_follows,  // else a burst follows
    output logic        [ 6:0] run                 // of this many samples
);
  logic [25:0] remaining_here;
  logic [6:0] run_ahead, run_next, run_here;
  logic jump_ahead, jump_next, jump_here;

  // Behind the jump, behind the sample, or where the walk stands.
  next_skip_test skip_test_ahead (
      .fineness(fineness),
      .skipping(skipping),
      .remaining(remaining_ahead),
      .jump(jump_ahead),
      .run(run_ahead)
  );
  assign remaining_next = remaining - 26'd1;
  next_skip_test skip_test_next (
      .fineness(fineness),
      .skipping(skipping),
      .remaining(remaining_next),
      .jump(jump_next),
      .run(run_next)
  );
  assign remaining_here = starts ? last : remaining;
  next_skip_test skip_test_here (
      .fineness(fineness),
      .skipping(skipping),
      .remaining(remaining_here),
      .jump(jump_here),
      .run(run_here)
  );

  logic [26:0] jump_length;
  logic signed [7:0] rest_leading;
  logic [4:0] level_up, level_ahead, next_level;

  // What remains behind a jump, if another one of its length would be too long.
  leading_one #(
      .W(26)
  ) leading_rest (
      .word(remaining & ~(26'h3ffffff << jump_log2)),
      .place(rest_leading)
  );
  assign jump_log2 = 6'(level) + 6'(fineness);
  assign jump_length = 27'd1 << jump_log2;
  assign level_up = level == pyramid_top ? level : level + 5'd1;
  always_comb begin
    if (!jump_ahead) level_ahead = '0;
    else if ({1'b0, remaining_ahead} >= jump_length << 1) level_ahead = level_up;
    else if ({1'b0, remaining_ahead} >= jump_length) level_ahead = level;
    else level_ahead = 5'(ahead_leading - $signed({5'b0, fineness}));
  end

  always_comb begin
    if (waits && clear) begin
      skip_test_follows = jump_ahead;
      next_level = level_ahead;
      run = run_ahead;
    end else if (passes) begin
      skip_test_follows = jump_next;
      next_level = '0;
      run = run_next;
    end else begin
      skip_test_follows = jump_here && !(waits && level == '0);
      next_level = waits && level != '0 ? level - 5'd1 : '0;
      run = run_here;
    end
  end

  always_ff @(posedge clock) begin
    if (tries) begin
      remaining_ahead <= remaining - jump_length[25:0];
      ahead_leading <= rest_leading;
    end
    if (starts) remaining <= last;
    else if (waits && bounded && clear) remaining <= remaining_ahead;
    else if (passes) remaining <= remaining_next;
    if (starts || (waits && bounded) || (passes && ends_burst)) level <= next_level;
  end
endmodule
