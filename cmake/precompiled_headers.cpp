// cmake/precompiled_headers.cpp: what a target of precompiled headers compiles, nothing.
