// What a target of precompiled headers compiles: nothing.
