#pragma once
// Lines `t`, by which OpenSubdiv's shapes say how they are to be subdivided.

#include "proto/text/obj_file.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {

// What is left of such a line. `point_count` and `face_count` are those of the whole file: tags count from 0.
// False: the cursor has failed.
bool read_obj_tag(TextCursor& cursor, Count point_count, Count face_count, ObjFile& file);

}  // namespace subdivd::proto::text
