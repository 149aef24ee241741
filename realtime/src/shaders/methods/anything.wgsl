// needs: frame camera interface cube noise environment front back background
// needs: layers media march eta absorption first_event trace parameters
// What a method without a line of needs may call.
